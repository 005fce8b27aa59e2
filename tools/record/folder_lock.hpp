// One export at a time in a folder, or the shards of one, each once at a time.
#pragma once

#include <optional>
#include <string>

#include "pelagic/tools/export/shard.hpp"
#include "pelagic/tools/files/output_folder.hpp"

namespace pelagic::tools {

/// Holds `.sea.lock` in the folder until it goes out of scope or the process dies, however that may be: it is the
/// kernel's lock on the open file (flock, which Linux carries over NFS and SMB too), not the file's being there. So the
/// file stays: whoever removed it might take it from under one who has just opened it.
///
/// Shards of one export hold it together, and each of them `.sea.3-of-8.lock` alone. Only who holds the folder alone may
/// remove that one.
class FolderLock {
   public:
    /// \param option  that named the folder, for messages
    /// \param shard   none: the folder is held alone
    /// Throws InputError if another process has it, or if the file system has no locks; FileError if the file can't be
    /// opened or is no regular one.
    explicit FolderLock(const OutputFolder& folder, const std::string& option = "--out",
                        const std::optional<Shard>& shard = {});

   private:
    Descriptor folder_, shard_;
};

}  // namespace pelagic::tools
