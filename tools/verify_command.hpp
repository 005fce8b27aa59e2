// `pelagic verify`: whether a finished export is still what was written, and what this machine would write.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/tools/options/compute_options.hpp"

namespace pelagic::tools {

class VerifyFlags {
   public:
    void add_to(CLI::App& app);
    /// Looks at the record, at every file against its hash, at sea.json, and computes a sample of the frames once more. If anything is wrong it
    /// names it on stderr, prints on stdout the line that makes it again, and throws FileError. Writes nothing.
    /// Throws InputError where there is no export, or one of another version of pelagic.
    void run() const;

   private:
    std::optional<std::string> folder_, sample_, seed_;
    ComputeFlags compute_;
};

}  // namespace pelagic::tools
