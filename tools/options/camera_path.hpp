// The camera's path of `render --path` as a CSV file. Its first line names the columns, in any order,
// and each further line is one key.
//
//   time                          seconds, increasing from line to line
//   x, y, z                       metres: position; without y if --eye-height gives the height
//   target_x, target_y, target_z  metres: point to look at
//
// Between keys, position and target follow cubic Hermite splines. A key's derivative is that of the
// parabola through the key and its two neighbours (for even times Catmull and Rom 1974), and at the
// ends that of the straight line to the neighbour. Before the first and after the last key the camera
// rests.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/quadtree/camera.hpp"

namespace pelagic::tools {

struct CameraPath {
    static constexpr std::size_t max_bytes = std::size_t{16} << 20, max_keys = 100'000;

    struct Key {
        double time_s = 0;
        glm::dvec3 position_m{}, target_m{};
    };

    std::vector<Key> keys;  ///< at least one; times increase

    /// Returns the position and target at a time.
    Key at(double time_s) const;
    double first_s() const { return keys.front().time_s; }
    double last_s() const { return keys.back().time_s; }
    double max_height_m() const;  ///< of the keys' positions
};

/// Parses a file's text.
/// \param name  path of the file, for messages
/// \param has_heights  the file has a column y; else it has none, and heights are 0
/// \throws InputError  with one line: file, line, what is wrong, what is accepted
CameraPath parse_camera_path(const std::string& name, std::string_view text, bool has_heights);

/// Reads and parses the file of --path. Throws as parse_camera_path() does.
std::shared_ptr<const CameraPath> read_camera_path(const std::string& file, bool has_heights);

/// How the camera moves; by default it stays where --camera places it.
struct CameraMotion {
    std::shared_ptr<const CameraPath> path = {};  ///< null: none
    /// Height above the water below the camera; unset: heights are absolute.
    std::optional<double> eye_height_m = {};
};

}  // namespace pelagic::tools
