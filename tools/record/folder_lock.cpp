#include "pelagic/tools/record/folder_lock.hpp"

#include <sys/file.h>

#include <cerrno>
#include <cstring>

#include "pelagic/tools/export/shard.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

/// \param how  LOCK_SH or LOCK_EX
Descriptor locked(const OutputFolder& folder, const std::string& option, const std::string& name, int how,
                  const std::string& needs) {
    Descriptor file = folder.open_for_lock(name);
    int reason = 0;
    do reason = ::flock(file.get(), how | LOCK_NB) == 0 ? 0 : errno;
    while (reason == EINTR);
    if (reason == EWOULDBLOCK) throw bad_value(option, folder.path().string(), needs + " and holds " + name);
    if (reason != 0)
        throw bad_value(option, folder.path().string(),
                        "a file system with locks (" + std::string(std::strerror(reason)) +
                            "), or --no-lock if no other export uses the folder");
    return file;
}

}  // namespace

FolderLock::FolderLock(const OutputFolder& folder, const std::string& option, const std::optional<Shard>& shard)
    : folder_(locked(folder, option, lock_name, shard ? LOCK_SH : LOCK_EX,
                     "a folder of its own: another export is at work there")) {
    if (shard)
        shard_ = locked(folder, option, lock_name_of(*shard), LOCK_EX,
                        "a folder where no other process exports shard " + text_of(*shard));
}

}  // namespace pelagic::tools
