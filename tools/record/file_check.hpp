// Comparison of files with their recorded hashes, on several threads.
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

/// Errors found in an export: the first max_kept in the export's order, and the total count. add()
/// may be called from several threads.
class Findings {
   public:
    static constexpr std::size_t max_kept = 20;

    /// \param place  index in the export, by which findings are sorted
    void add(std::size_t place, const std::string& what);
    std::size_t count() const { return count_; }
    /// Prints one line for each on stderr, and a line with the total count if there are more.
    void print() const;

   private:
    mutable std::mutex mutex_;
    std::multimap<std::size_t, std::string> first_;
    std::size_t count_ = 0;
};

/// Hashes files on several threads.
class FileCheck {
   public:
    /// \param threads   number of threads; 0: one for each core
    /// \param is_wrong  called with the place of each file that is missing, unreadable or
    ///     different; from any thread
    FileCheck(const OutputFolder& folder, int threads,
              std::function<void(std::size_t place, const std::string& what)> is_wrong);
    ~FileCheck();
    FileCheck(const FileCheck&) = delete;

    /// Queues files. Blocks while the queue is full.
    /// \param place  index in the export
    void add(std::size_t place, std::vector<FileRecord> files);
    /// Waits until all queued files have been checked. Rethrows an exception of a worker thread.
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
