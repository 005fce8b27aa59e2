// One export at a time in a folder.
#pragma once

#include "pelagic/tools/output_folder.hpp"

namespace pelagic::tools {

/// Holds `.sea.lock` in the folder until it goes out of scope or the process dies, however that may be: it is the
/// kernel's lock on the open file (flock, which Linux carries over NFS and SMB too), not the file's being there. So the
/// file stays: whoever removed it might take it from under one who has just opened it.
class FolderLock {
   public:
    /// Throws InputError if another process has it, or if the file system has no locks; FileError if the file can't be
    /// opened or is no regular one.
    explicit FolderLock(const OutputFolder& folder);

   private:
    Descriptor file_;
};

}  // namespace pelagic::tools
