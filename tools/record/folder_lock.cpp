#include "pelagic/tools/record/folder_lock.hpp"

#include <cerrno>
#include <cstring>

#include "pelagic/tools/export/shard.hpp"
#include "pelagic/tools/files/open_file.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

Descriptor locked(const OutputFolder& folder, const std::string& option, const std::string& name, LockKind kind,
                  const std::string& needs) {
    Descriptor file = folder.open_for_lock(name);
    const int reason = try_lock(file, kind);
    if (reason == EWOULDBLOCK) throw bad_value(option, folder.path().string(), needs + " and holds " + name);
    if (reason != 0)
        throw bad_value(option, folder.path().string(),
                        "a file system with locks (" + std::string(std::strerror(reason)) +
                            "), or --no-lock if no other export uses the folder");
    return file;
}

}  // namespace

FolderLock::FolderLock(const OutputFolder& folder, const std::string& option, const std::optional<Shard>& shard)
    : folder_(locked(folder, option, lock_name, shard ? LockKind::shared : LockKind::exclusive,
                     "a folder of its own: another export is at work there")) {
    if (shard)
        shard_ = locked(folder, option, lock_name_of(*shard), LockKind::exclusive,
                        "a folder where no other process exports shard " + text_of(*shard));
}

}  // namespace pelagic::tools
