// --floor, what places it, and --shore: what lies below the sea, from an image, and whether waves feel it.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/sim/shore.hpp"
#include "pelagic/tools/options/sea_options.hpp"

namespace pelagic::tools {

struct FloorOptions {
    std::optional<ShoreOptions> field;  ///< none: even
    bool waves_feel_it = false;         ///< only where there is a field

    std::optional<ShoreOptions> shore() const { return waves_feel_it ? field : std::nullopt; }
};

class FloorFlags {
   public:
    void add_to(CLI::App& app);
    /// Reads the image: a row is a line along x, the upper one has the least z. Throws InputError, one line that names option, value
    /// and what is accepted, also where such a sea can have no shore.
    FloorOptions resolve(const ResolvedSea& sea) const;
    bool has_floor() const { return file_.has_value(); }
    bool has_shore() const { return shore_; }
    /// As it was typed, " --floor FILE ..."; empty without a floor.
    std::string typed() const;

   private:
    ShoreOptions read_field() const;

    std::optional<std::string> file_, size_, middle_, heights_;
    bool shore_ = false;
};

}  // namespace pelagic::tools
