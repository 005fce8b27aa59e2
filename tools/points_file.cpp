#include "pelagic/tools/points_file.hpp"

#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "pelagic/tools/errors.hpp"
#include "pelagic/tools/option_text.hpp"

namespace pelagic::tools {
namespace {

// Beyond any ocean, and where doubles still tell metres apart.
constexpr double farthest_m = 1e15;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::optional<double> coordinate(std::string_view text) {
    const auto value = parse_number(trimmed(text));
    return value && std::fabs(*value) <= farthest_m ? value : std::nullopt;
}

}  // namespace

PointList read_points(const std::filesystem::path& file) {
    constexpr const char* accepted = "a CSV file of lines x,z";
    if (std::filesystem::is_directory(file)) throw bad_value("--points", file.string() + ", a folder", accepted);
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw bad_value("--points", file.string() + ", which can't be read", accepted);

    PointList points;
    std::string line;
    bool may_be_header = true;
    for (std::size_t number = 1; std::getline(stream, line); ++number) {
        std::string_view text = trimmed(line);
        if (number == 1 && text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte order mark
        if (text.empty()) continue;
        const auto comma = text.find(',');
        const std::string_view first = trimmed(text.substr(0, comma));
        const std::string_view second = comma == std::string_view::npos ? "" : trimmed(text.substr(comma + 1));
        if (std::exchange(may_be_header, false) && first == "x" && second == "z") continue;
        const auto x = coordinate(first), z = coordinate(second);
        if (!x || !z)
            throw InputError(file.string() + ":" + number_text(number) + ": the line is " +
                             std::string(text.substr(0, 80)) + ", needs x,z: two numbers of metres in [-1e15, 1e15]");
        points.x.push_back(*x);
        points.z.push_back(*z);
    }
    if (stream.bad()) throw bad_value("--points", file.string() + ", which can't be read", accepted);
    return points;
}

}  // namespace pelagic::tools
