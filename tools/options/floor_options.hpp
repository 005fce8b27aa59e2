// The options --floor, --floor-size, --floor-middle, --floor-heights and --shore: sea-floor heights
// from an image, and their effect on waves.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/sim/shore.hpp"
#include "pelagic/tools/options/sea_options.hpp"

namespace pelagic::tools {

struct FloorOptions {
    std::optional<ShoreOptions> field;  ///< unset: a flat floor
    bool waves_feel_it = false;         ///< true for --shore; requires a field

    std::optional<ShoreOptions> shore() const { return waves_feel_it ? field : std::nullopt; }
};

class FloorFlags {
   public:
    void add_to(CLI::App& app);
    /// Checks the options and reads the image. Rows of the image are along x; the upper row has the
    /// lowest z.
    /// \throws InputError  on one line with option, value and accepted values, also if this sea
    ///                     cannot have a shore
    FloorOptions resolve(const ResolvedSea& sea) const;
    bool has_floor() const { return file_.has_value(); }
    bool has_shore() const { return shore_; }
    /// Returns the options as given on the command line, " --floor FILE ..."; empty without a
    /// floor.
    std::string typed() const;

   private:
    ShoreOptions read_field() const;

    std::optional<std::string> file_, size_, middle_, heights_;
    bool shore_ = false;
};

}  // namespace pelagic::tools
