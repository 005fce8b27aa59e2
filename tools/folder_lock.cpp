#include "pelagic/tools/folder_lock.hpp"

#include <sys/file.h>

#include <cerrno>
#include <cstring>

#include "pelagic/tools/errors.hpp"
#include "pelagic/tools/export_names.hpp"

namespace pelagic::tools {

FolderLock::FolderLock(const OutputFolder& folder) : file_(folder.open_for_lock(lock_name)) {
    int reason = 0;
    do reason = ::flock(file_.get(), LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
    while (reason == EINTR);
    if (reason == EWOULDBLOCK)
        throw bad_value("--out", folder.path().string(),
                        "a folder of its own: another export is at work there and holds " + std::string(lock_name));
    if (reason != 0)
        throw bad_value("--out", folder.path().string(),
                        "a file system with locks (" + std::string(std::strerror(reason)) +
                            "), or --no-lock if no other export uses the folder");
}

}  // namespace pelagic::tools
