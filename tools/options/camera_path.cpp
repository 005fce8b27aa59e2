#include "pelagic/tools/options/camera_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "pelagic/tools/files/input_file.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

constexpr double farthest_key_m = 1e7, latest_key_s = 1e9;  // as of --camera and --time
constexpr double min_view_m = 1e-6;
constexpr std::array<std::string_view, 7> path_columns = {"time",     "x",        "y",       "z",
                                                          "target_x", "target_y", "target_z"};
constexpr std::size_t time_column = 0, height_column = 2;
constexpr std::string_view columns_with_height = "time,x,y,z,target_x,target_y,target_z";
constexpr std::string_view columns_without_height = "time,x,z,target_x,target_y,target_z (--eye-height replaces y)";

class PathReader {
   public:
    PathReader(const std::string& name, bool has_heights, CameraPath& path)
        : name_(name), has_heights_(has_heights), path_(path) {}

    void take_line(std::string_view line) {
        ++line_number_;
        if (line_number_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);  // byte order mark
        line = trimmed(line);
        if (line.empty()) return;
        std::vector<std::string> cells = split_at_commas(line);
        for (std::string& cell : cells) cell = std::string(trimmed(cell));
        if (columns_.empty()) return take_header(line, cells);
        if (cells.size() != columns_.size())
            reject("the number of columns", number_text(cells.size()),
                   number_text(columns_.size()) + ", as in the first line");
        if (path_.keys.size() == CameraPath::max_keys)
            reject("the number of keys", "more", "at most " + number_text(CameraPath::max_keys));
        take_key(cells);
    }

    std::string_view accepted_names() const { return has_heights_ ? columns_with_height : columns_without_height; }

   private:
    [[noreturn]] void reject(std::string_view what, std::string_view value, const std::string& accepted) const {
        constexpr std::size_t longest = 80;
        throw InputError(name_ + ":" + number_text(line_number_) + ": " +
                         invalid_value_message(what, value.substr(0, longest), accepted));
    }

    void take_header(std::string_view line, const std::vector<std::string>& cells) {
        const std::size_t count = has_heights_ ? path_columns.size() : path_columns.size() - 1;
        for (const std::string& cell : cells) {
            const auto column = static_cast<std::size_t>(std::ranges::find(path_columns, cell) - path_columns.begin());
            const bool is_named = column < path_columns.size() && (has_heights_ || column != height_column);
            if (!is_named || std::ranges::find(columns_, column) != columns_.end()) break;
            columns_.push_back(column);
        }
        if (columns_.size() != count || cells.size() != count)
            reject("the first line", line, "the columns " + std::string(accepted_names()));
    }

    void take_key(const std::vector<std::string>& cells) {
        std::array<double, path_columns.size()> values{};
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const bool is_time = columns_[i] == time_column;
            const auto value = parse_number(cells[i]);
            if (!value || std::abs(*value) > (is_time ? latest_key_s : farthest_key_m))
                reject(path_columns[columns_[i]], cells[i],
                       is_time ? "seconds in [-1e9, 1e9]" : "metres in [-1e7, 1e7]");
            values[columns_[i]] = *value;
        }
        const CameraPath::Key key{
            values[0], {values[1], values[2], values[3]}, {values[4], values[5], values[6]}};
        if (!path_.keys.empty() && key.time_s <= path_.keys.back().time_s)
            reject("time", number_text(key.time_s), "more than " + number_text(path_.last_s()) + " of the key before");
        if (has_heights_ && glm::distance(key.position_m, key.target_m) < min_view_m)
            reject("target_x,target_y,target_z", "the camera's position", "another place");
        path_.keys.push_back(key);
    }

    const std::string& name_;
    bool has_heights_;
    CameraPath& path_;
    std::vector<std::size_t> columns_;  ///< indices of path_columns
    std::size_t line_number_ = 0;
};

/// Returns the derivative at key i of a value of the keys.
glm::dvec3 derivative(const std::vector<CameraPath::Key>& keys, std::size_t i, glm::dvec3 CameraPath::Key::*value) {
    const auto slope = [&](std::size_t from) {
        return (keys[from + 1].*value - keys[from].*value) / (keys[from + 1].time_s - keys[from].time_s);
    };
    if (i == 0) return slope(0);
    if (i + 1 == keys.size()) return slope(i - 1);
    const double before_s = keys[i].time_s - keys[i - 1].time_s, after_s = keys[i + 1].time_s - keys[i].time_s;
    return (after_s * slope(i - 1) + before_s * slope(i)) / (before_s + after_s);
}

}  // namespace

CameraPath::Key CameraPath::at(double time_s) const {
    if (time_s <= first_s()) return keys.front();
    if (time_s >= last_s()) return keys.back();
    const auto next = std::ranges::upper_bound(keys, time_s, {}, &Key::time_s);
    const auto end = static_cast<std::size_t>(next - keys.begin()), begin = end - 1;
    const double span_s = keys[end].time_s - keys[begin].time_s, u = (time_s - keys[begin].time_s) / span_s;
    const auto spline = [&](glm::dvec3 Key::*value) {
        const glm::dvec3 from = span_s * derivative(keys, begin, value), to = span_s * derivative(keys, end, value);
        return keys[begin].*value + (u * u * (3 - 2 * u)) * (keys[end].*value - keys[begin].*value) +
               (u * (1 - u) * (1 - u)) * from - (u * u * (1 - u)) * to;
    };
    return {time_s, spline(&Key::position_m), spline(&Key::target_m)};
}

double CameraPath::max_height_m() const {
    double highest = keys.front().position_m.y;
    for (const Key& key : keys) highest = std::max(highest, key.position_m.y);
    return highest;
}

CameraPath parse_camera_path(const std::string& name, std::string_view text, bool has_heights) {
    CameraPath path;
    PathReader reader(name, has_heights, path);
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        reader.take_line(line);
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    if (path.keys.empty())
        throw InputError(name + " holds no keys, expected a first line " + std::string(reader.accepted_names()) +
                         ", and lines of numbers");
    return path;
}

std::shared_ptr<const CameraPath> read_camera_path(const std::string& file, bool has_heights) {
    InputFile input("--path", file,
                    "a CSV file with the columns " +
                        std::string(has_heights ? columns_with_height : columns_without_height));
    return std::make_shared<const CameraPath>(
        parse_camera_path(input.name(), input.read_all(CameraPath::max_bytes), has_heights));
}

}  // namespace pelagic::tools
