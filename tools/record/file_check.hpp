// Files against their recorded hashes, several at once.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "pelagic/tools/files/output_folder.hpp"
#include "pelagic/tools/record/sea_json.hpp"

namespace pelagic::tools {

/// What is wrong in an export: the first few in its order, and how many there are. May be told by several threads.
class Findings {
   public:
    static constexpr std::size_t max_kept = 20;

    /// \param place  in the export, by which findings are ordered
    void add(std::size_t place, const std::string& what);
    std::size_t count() const { return count_; }
    /// A line each, and one with the number of all if they are more, on stderr.
    void print() const;

   private:
    mutable std::mutex mutex_;
    std::multimap<std::size_t, std::string> first_;
    std::size_t count_ = 0;
};

/// Reads files on a few threads.
class FileCheck {
   public:
    /// \param threads   0: one a core
    /// \param is_wrong  is told the place of each file that is missing, unreadable or has other bytes; from any thread
    FileCheck(const OutputFolder& folder, int threads,
              std::function<void(std::size_t place, const std::string& what)> is_wrong);
    ~FileCheck();
    FileCheck(const FileCheck&) = delete;

    /// Waits if many are still to be read. \param place  in the export
    void add(std::size_t place, std::vector<FileRecord> files);
    /// Returns when all are read.
    void finish();

   private:
    struct Work {
        std::size_t place;
        std::vector<FileRecord> files;
    };
    void read_files();
    void check(const Work& work);

    const OutputFolder& folder_;
    const std::function<void(std::size_t, const std::string&)> is_wrong_;
    std::mutex mutex_;
    std::condition_variable work_came_, work_went_;
    std::deque<Work> waiting_;
    bool is_last_ = false;
    std::exception_ptr failure_;
    std::vector<std::thread> threads_;
};

}  // namespace pelagic::tools
