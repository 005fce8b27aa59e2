#include "pelagic/tools/record/option_flags.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace pelagic::tools {
namespace {

/// Keys whose names differ from their options.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> other_flags = {
    {{"mesh_formats", "--mesh"},
     {"mesh_side_m", "--mesh-size"},
     {"mesh_cascades", "--mesh-size"},
     {"events_xxh3", "--events"},
     {"frame_numbers", "--frames"},
     {"loop", "--loop-frames"},
     {"names", "--out"}}};

std::string flag_without_unit(std::string key, std::initializer_list<std::string_view> units) {
    for (const std::string_view unit : units)
        if (key.ends_with(unit)) {
            key.resize(key.size() - unit.size());
            break;
        }
    std::replace(key.begin(), key.end(), '_', '-');
    return "--" + key;
}

}  // namespace

std::string flag_of(const std::string& key) {
    for (const auto& [other_key, flag] : other_flags)
        if (key == other_key) return std::string(flag);
    return flag_without_unit(key, {"_mps", "_s", "_m"});
}

std::string flag_at(std::string_view pointer) {
    std::string key(pointer.substr(std::min<std::size_t>(1, pointer.size())));
    const auto remove = [&](std::string_view start) {
        if (!key.starts_with(start)) return false;
        key.erase(0, start.size());
        return true;
    };
    if (remove("weather")) return "--weather";
    if (remove("sea/")) return flag_without_unit(key, {"_mps", "_deg", "_m", "_s"});
    if (!remove("export/")) return key;
    std::replace(key.begin(), key.end(), '/', '_');
    return flag_of(key);
}

std::string typed_value(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_array()) return value.dump();
    std::string list;
    for (const Json& item : value) list.append(list.empty() ? "" : ",").append(typed_value(item));
    return list.empty() ? "none" : list;
}

}  // namespace pelagic::tools
