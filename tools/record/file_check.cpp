#include "pelagic/tools/record/file_check.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/message/one_line.hpp"
#include "pelagic/tools/files/digest.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

constexpr std::size_t max_waiting = 256;

}  // namespace

void Findings::add(std::size_t place, const std::string& what) {
    const std::lock_guard lock(mutex_);
    ++count_;
    first_.emplace(place, what);
    if (first_.size() > max_kept) first_.erase(std::prev(first_.end()));
}

void Findings::print() const {
    for (const auto& [place, what] : first_) std::fprintf(stderr, "pelagic: %s\n", escaped(what).c_str());
    if (count_ > first_.size())
        std::fprintf(stderr, "pelagic: and %zu more, %zu in all\n", count_ - first_.size(), count_);
}

FileCheck::FileCheck(const OutputFolder& folder, int threads,
                     std::function<void(std::size_t, const std::string&)> is_wrong)
    : folder_(folder), is_wrong_(std::move(is_wrong)) {
    const auto count = static_cast<std::size_t>(threads > 0 ? threads : default_thread_count());
    try {
        while (threads_.size() < count) threads_.emplace_back([this] { read_files(); });
    } catch (const std::exception&) {
        // The system cannot start more threads, or there is no memory for them. Without any, add()
        // reads the files itself.
    }
}

FileCheck::~FileCheck() {
    {
        const std::lock_guard lock(mutex_);
        is_last_ = true;
        waiting_.clear();
    }
    work_came_.notify_all();
    for (std::thread& thread : threads_)
        if (thread.joinable()) thread.join();
}

void FileCheck::add(std::size_t place, std::vector<FileRecord> files) {
    if (threads_.empty()) return check({place, std::move(files)});
    std::unique_lock lock(mutex_);
    work_went_.wait(lock, [&] { return waiting_.size() < max_waiting || failure_; });
    if (failure_) std::rethrow_exception(failure_);
    waiting_.push_back({place, std::move(files)});
    work_came_.notify_one();
}

void FileCheck::finish() {
    {
        const std::lock_guard lock(mutex_);
        is_last_ = true;
    }
    work_came_.notify_all();
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
    if (failure_) std::rethrow_exception(failure_);
}

void FileCheck::read_files() {
    std::unique_lock lock(mutex_);
    for (;;) {
        work_came_.wait(lock, [&] { return !waiting_.empty() || is_last_; });
        if (waiting_.empty()) return;
        const Work work = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        work_went_.notify_one();
        try {
            check(work);
            lock.lock();
        } catch (...) {  // for example std::bad_alloc
            lock.lock();
            if (!failure_) failure_ = std::current_exception();
            waiting_.clear();
            work_went_.notify_one();
        }
    }
}

void FileCheck::check(const Work& work) {
    const auto report = [&](const std::string& what) { is_wrong_(work.place, what); };
    for (const FileRecord& file : work.files) try {
            Digest digest;
            const bool is_there = folder_.read(file.name, [&](std::string_view piece) {
                digest.add(piece);
                return true;
            });
            if (!is_there)
                report(file.name + " is missing");
            else if (digest.text() != file.xxh3)
                report(file.name + " has other bytes than were written: XXH3 " + digest.text() + ", expected " +
                       file.xxh3);
        } catch (const FileError& error) {
            report(error.what());
        }
}

}  // namespace pelagic::tools
