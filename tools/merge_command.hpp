// `pelagic merge`: the shards of an export become one export, if all of it is there.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/tools/options/compute_options.hpp"

namespace pelagic::tools {

class MergeFlags {
   public:
    void add_to(CLI::App& app);
    /// Checks every record and every file, then writes sea_files.json and sea.json and removes what was the shards'. If anything is missing or wrong
    /// it touches nothing, names it on stderr, prints on stdout a line for each shard that makes it again, and throws FileError.
    /// Throws InputError where records are of different exports, or of another version of pelagic.
    void run() const;

   private:
    std::optional<std::string> folder_;
    ComputeFlags compute_;
    bool no_lock_ = false;
};

}  // namespace pelagic::tools
