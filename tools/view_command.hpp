// `pelagic view`: the sea in a window.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/tools/options/scene_options.hpp"

namespace pelagic::tools {

class ViewFlags {
   public:
    void add_to(CLI::App& app);
    /// Shows the window until it is closed, then prints the command that draws what was seen last. Throws InputError,
    /// FileError and gl::GlError.
    void run() const;

   private:
    SceneFlags scene_;
    std::optional<std::string> images_;
};

}  // namespace pelagic::tools
