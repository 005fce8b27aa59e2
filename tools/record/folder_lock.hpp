// Locks that allow one export at a time in a folder, or several different shards of one export.
#pragma once

#include <optional>
#include <string>

#include "pelagic/tools/export/shard.hpp"
#include "pelagic/tools/files/output_folder.hpp"

namespace pelagic::tools {

/// Locks `.sea.lock` in the folder until the object is destroyed or the process ends. The lock is
/// the kernel's lock on the open file (flock, which Linux also supports over NFS and SMB; LockFileEx on
/// Windows), not the
/// existence of the file. The file is never removed, since another process may have just opened it.
///
/// Shards of one export share this lock, and each holds `.sea.3-of-8.lock` exclusively. Only a
/// process that holds `.sea.lock` exclusively may remove the lock of a shard.
class FolderLock {
   public:
    /// \param option  option that named the folder, for error messages
    /// \param shard   none: lock the folder exclusively
    /// \throws InputError  if another process holds the lock, or the file system does not support
    /// locks
    /// \throws FileError  if the lock file cannot be opened or is not a regular file
    explicit FolderLock(const OutputFolder& folder, const std::string& option = "--out",
                        const std::optional<Shard>& shard = {});

   private:
    Descriptor folder_, shard_;
};

}  // namespace pelagic::tools
