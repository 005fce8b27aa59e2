// --floor and what places it: what lies below the sea, from an image.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/gl/sea_floor.hpp"

namespace pelagic::tools {

class FloorFlags {
   public:
    void add_to(CLI::App& app);
    /// Even without --floor. Reads the image: a row is a line along x, the upper one has the least z. Throws InputError, one
    /// line that names option, value and what is accepted.
    gl::SeaFloor resolve() const;
    /// As it was typed, " --floor FILE ..."; empty without a floor.
    std::string typed() const;

   private:
    std::optional<std::string> file_, size_, middle_, heights_;
};

}  // namespace pelagic::tools
