#include "pelagic/tools/benchmark/stored_results.hpp"

#include <nlohmann/json.hpp>
#include <utility>

namespace pelagic::tools {
namespace {

#include "pelagic/generated/stored_results.inc"

const nlohmann::json& instructions() {
    static const nlohmann::json json = nlohmann::json::parse(stored_instructions_json);
    return json;
}

}  // namespace

std::vector<MachineFrames> stored_frames() {
    std::vector<MachineFrames> all;
    for (const std::string_view text : stored_results_json) {
        const auto json = nlohmann::json::parse(text);
        const std::string machine = json.at("cpu").get<std::string>() + ", " + json.at("compiler").get<std::string>();
        std::map<std::string, MachineFrames> by_isa;
        for (const auto& row : json.at("rows")) {
            if (row.at("threads") != 1 || row.value("cascades", 1) != 1) continue;
            const auto isa = row.at("isa").get<std::string>();
            MachineFrames& frames = by_isa.try_emplace(isa, MachineFrames{machine, isa}).first->second;
            const int resolution = row.at("n").get<int>();
            // `ours_ms` is of frames without planes if the row has both.
            frames.ms[resolution] = row.value("ours_planes_ms", row.at("ours_ms").get<double>());
            if (row.contains("fftw_ms")) frames.fftw_ms[resolution] = row.at("fftw_ms").get<double>();
        }
        for (auto& [isa, frames] : by_isa) all.push_back(std::move(frames));
    }
    return all;
}

std::optional<double> stored_instructions(std::string_view sea, std::string_view job, Isa isa) {
    for (const auto& row : instructions().at("budgets"))
        if (row.at("sea") == sea && row.at("job") == job && row.at("isa") == name_of(isa))
            return row.at("instructions").get<double>();
    return {};
}

std::optional<double> stored_bytes(std::string_view sea, std::size_t cache_bytes) {
    static const nlohmann::json json = nlohmann::json::parse(stored_bytes_json);
    std::optional<double> bytes;
    for (const auto& row : json.at("bytes_a_texel"))  // by sea, in the order of sizes
        if (row.at("sea") == sea && row.at("cache_bytes").get<std::size_t>() <= cache_bytes)
            bytes =
                row.at("read").get<double>() + row.at("for_writing").get<double>() + row.at("written").get<double>();
    return bytes;
}

std::string stored_instructions_compiler() { return instructions().at("compiler").get<std::string>(); }

}  // namespace pelagic::tools
