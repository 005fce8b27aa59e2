#include "pelagic/tools/info_command.hpp"

#include <cstdio>
#include <string>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/digest.hpp"
#include "pelagic/tools/sea_json.hpp"

namespace pelagic::tools {
namespace {

Json info_json(const ResolvedSea& resolved, const ComputeOptions& compute) {
    Ocean ocean(resolved.sea, {.executor = make_default_executor(compute.threads), .isa = compute.isa});
    const Frame& frame = ocean.frame_at(0);

    Json stages = Json::array();
    for (const Stage& stage : ocean.graph().stages())
        stages.push_back({{"name", stage.name}, {"count", stage.count}, {"batch", stage.batch}});
    Json isas = Json::array();
    for (const Isa isa : isas_here()) isas.push_back(name_of(isa));

    Json json = {{"version", PELAGIC_VERSION}, {"sea", sea_as_json(resolved)}};
    if (!resolved.preset.empty()) json["preset"] = resolved.preset;
    json["waves"] = waves_as_json(resolved.sea, measured_significant_wave_height_m(frame));
    json["first_frame"] = {{"hash", hex_text(hash_of(frame))},
                           {"height_min_m", frame.bounds.height_min_m},
                           {"height_max_m", frame.bounds.height_max_m},
                           {"sideways_x_max_m", frame.bounds.sideways_x_max_m},
                           {"sideways_z_max_m", frame.bounds.sideways_z_max_m}};
    json["warnings"] = warnings_about(resolved.sea);
    json["computing"] = {{"isa", name_of(ocean.isa())},          {"isas_here", isas},
                         {"executor", ocean.executor().name()},  {"threads", ocean.executor().thread_limit()},
                         {"memory_bytes", ocean.memory_bytes()}, {"stages", stages}};
    return json;
}

/// Four digits of what is computed, and six of what was asked for: more mean nothing to a reader, and --json has all.
std::string value_text(const Json& value, int digits) {
    if (value.is_string()) return value.get<std::string>();
    return value.is_number_float() ? rounded_text(value.get<double>(), digits) : value.dump();
}

void print_section(const char* title, const Json& values, int digits = 4) {
    std::printf("%s\n", title);
    for (const auto& [key, value] : values.items()) {
        if (value.is_object() && !value.empty()) {
            std::string parts;
            for (const auto& [name, part] : value.items())
                parts += (parts.empty() ? "" : ", ") + name + " " + value_text(part, digits);
            std::printf("  %-28s%s\n", key.c_str(), parts.c_str());
        } else {
            std::printf("  %-28s%s\n", key.c_str(), value_text(value, digits).c_str());
        }
    }
}

void print_table(const Json& json) {
    const std::string preset = json.value("preset", "");
    print_section(("Sea" + (preset.empty() ? "" : ", preset " + preset)).c_str(), json.at("sea"), 6);
    print_section("Waves", json.at("waves"));
    print_section("Frame at 0 s", json.at("first_frame"));
    Json computing = json.at("computing");
    std::string stages;
    for (const Json& stage : computing.at("stages"))
        stages += (stages.empty() ? "" : " -> ") + stage.at("name").get<std::string>();
    computing["stages"] = stages;
    print_section("Computing", computing);
    for (const Json& warning : json.at("warnings")) std::printf("note: %s\n", warning.get<std::string>().c_str());
}

}  // namespace

void InfoFlags::add_to(CLI::App& app) {
    app.add_flag("--json", json_, "for programs");
    sea_.add_to(app);
    compute_.add_to(app);
}

void InfoFlags::run() const {
    const Json json = info_json(sea_.resolve(), compute_.resolve());
    if (json_)
        std::printf("%s\n", json.dump(2).c_str());
    else
        print_table(json);
}

}  // namespace pelagic::tools
