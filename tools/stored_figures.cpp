#include "pelagic/tools/stored_figures.hpp"

#include <nlohmann/json.hpp>

namespace pelagic::tools {
namespace {

#include "pelagic/generated/stored_figures.inc"

const nlohmann::json& instructions() {
    static const nlohmann::json json = nlohmann::json::parse(stored_instructions_json);
    return json;
}

}  // namespace

std::vector<StoredFrame> stored_frames() {
    std::vector<StoredFrame> frames;
    for (const std::string_view text : stored_results_json) {
        const auto json = nlohmann::json::parse(text);
        const std::string machine = json.at("cpu").get<std::string>() + ", " + json.at("compiler").get<std::string>();
        for (const auto& row : json.at("rows")) {
            if (row.at("threads") != 1 || row.value("tiles", 1) != 1) continue;
            auto& frame = frames.emplace_back();
            frame.machine = machine;
            frame.isa = row.at("isa").get<std::string>();
            frame.resolution = row.at("n").get<int>();
            frame.ms = row.at("ours_ms").get<double>();
            if (row.contains("fftw_ms")) frame.fftw_ms = row.at("fftw_ms").get<double>();
        }
    }
    return frames;
}

std::optional<double> stored_instructions(std::string_view sea, std::string_view job, Isa isa) {
    for (const auto& row : instructions().at("budgets"))
        if (row.at("sea") == sea && row.at("job") == job && row.at("isa") == name_of(isa))
            return row.at("instructions").get<double>();
    return {};
}

std::string stored_instructions_compiler() { return instructions().at("compiler").get<std::string>(); }

}  // namespace pelagic::tools
