#include "pelagic/tools/hulls/hull_options.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "pelagic/floating/given_coefficients.hpp"
#include "pelagic/tools/files/input_file.hpp"
#include "pelagic/tools/meshes/hull_file.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"
#include "pelagic/tools/text/path_text.hpp"
#include "pelagic/tools/text/progress.hpp"

namespace pelagic::tools {
namespace {

/// Returns numbers that commas separate, each in [-limit, limit].
std::vector<double> numbers_in(const std::string& option, const std::string& text, std::size_t count, double limit,
                               const std::string& accepted) {
    std::vector<double> numbers;
    for (const std::string& part : split_at_commas(text)) {
        const auto value = parse_number(part);
        if (!value || std::fabs(*value) > limit) throw bad_value(option, text, accepted);
        numbers.push_back(*value);
    }
    if (numbers.size() != count) throw bad_value(option, text, accepted);
    return numbers;
}

/// Reads STEM.1, and STEM.3 if there is one.
std::shared_ptr<const GivenCoefficients> coefficients_of(const Hull& hull, const std::string& stem) {
    constexpr const char *option = "--hull-coefficients", *accepted = "the name before .1 and .3 of WAMIT's files";
    constexpr std::size_t max_bytes = 32'000'000;
    if (stem.empty()) throw InputError(std::string(option) + " is empty, expected " + accepted);
    const std::string radiation_name = stem + ".1", excitation_name = stem + ".3";
    const std::string radiation = InputFile(option, path_of(radiation_name), accepted).read_all(max_bytes);
    std::string excitation;
    std::error_code unknown;
    if (std::filesystem::exists(path_of(excitation_name), unknown)) {
        excitation = InputFile(option, path_of(excitation_name), accepted).read_all(max_bytes);
        if (excitation.empty()) throw InputError(std::string(option) + ": " + excitation_name + " is empty");
    }
    try {
        return read_coefficients(hull, {radiation, excitation, radiation_name, excitation_name});
    } catch (const std::invalid_argument& error) {
        throw InputError(std::string(option) + ": " + error.what());
    }
}

}  // namespace

void require_reachable(double first_s, double last_s) {
    constexpr double longest_s = 86400;
    if (last_s - first_s > longest_s)
        throw InputError("--hull with times from " + number_text(first_s) + " to " + number_text(last_s) +
                         " s, expected at most 86400 s: each step is computed");
}

void HullFlags::add_to(CLI::App& app) {
    const auto add = [&](const char* name, std::optional<std::string>& typed, const char* type, const char* help) {
        app.add_option(name, typed, help)->type_name(type)->group(help_group::hull);
    };
    add("--hull", file_, "FILE.gltf|glb|obj", "let a closed mesh float; metres, x forward, y up, z to starboard");
    add("--mass", mass_, "KG", "mass of the hull; [1e-6, 1e10]");
    add("--hull-position", position_, "X,Z",
        "place of its launch in metres, 10 s before the first time (default: 0,0)");
    add("--hull-heading", heading_, "DEGREES", "from east (+x) towards south (+z); [-360, 360] (default: 0)");
    add("--hull-center", center_, "X,Y,Z", "centre of mass in the axes of the mesh (default: that of its volume)");
    add("--hull-coefficients", coefficients_, "STEM",
        "read A and B of a panel method from STEM.1 and wave forces from STEM.3, if there is one");
    add("--hull-thrust", thrust_, "NEWTONS", "force towards the bow; [-1e12, 1e12] (default: 0)");
}

std::optional<HullLaunch> HullFlags::resolve() const {
    if (!file_) {
        for (const auto& [flag, typed] : {std::pair("--mass", &mass_),
                                          {"--hull-position", &position_},
                                          {"--hull-heading", &heading_},
                                          {"--hull-center", &center_},
                                          {"--hull-coefficients", &coefficients_},
                                          {"--hull-thrust", &thrust_}})
            if (*typed) throw InputError(std::string(flag) + " is " + **typed + "; it requires --hull");
        return {};
    }
    if (!mass_) throw InputError("--mass is missing: --hull needs the mass of the hull in kilograms");
    HullLaunch launch;
    launch.typed = "--mass " + *mass_ + (thrust_ ? " --hull-thrust " + *thrust_ : "");
    HullOptions options;
    options.mass_kg = number_in("--mass", *mass_, 1e-6, 1e10, "[1e-6, 1e10] kg");
    if (position_) {
        const auto place =
            numbers_in("--hull-position", *position_, 2, 1e7, "X,Z: two numbers of metres in [-1e7, 1e7]");
        launch.x_m = place[0], launch.z_m = place[1];
    }
    if (heading_)
        launch.heading_rad =
            number_in("--hull-heading", *heading_, -360, 360, "[-360, 360] degrees") * (std::numbers::pi / 180);
    if (thrust_) launch.thrust_n = number_in("--hull-thrust", *thrust_, -1e12, 1e12, "[-1e12, 1e12] N");
    if (center_) {
        const auto at =
            numbers_in("--hull-center", *center_, 3, 1000, "X,Y,Z: three numbers of metres within the mesh");
        options.centre_of_mass_m = glm::dvec3(at[0], at[1], at[2]);
    }
    if (file_->empty()) throw InputError("--hull is empty, expected an OBJ or glTF 2.0 file");
    HullMesh mesh = read_hull("--hull", path_of(*file_));
    if (options.centre_of_mass_m && !Hull::check(mesh, options).empty())
        throw InputError("--hull-center is " + *center_ + ": " + Hull::check(mesh, options));
    launch.hull = std::make_shared<const Hull>(std::move(mesh), options);
    const HullAfloat& afloat = launch.hull->afloat();
    if (!afloat.floats)
        throw bad_value("--mass", *mass_,
                        "less than " +
                            rounded_text(options.water_density_kgpm3 * launch.hull->mesh().volume_m3(), 4) +
                            " kg, with which the hull sinks");
    if (!(afloat.roll_gm_m > 0 && afloat.pitch_gm_m > 0))
        print_note("the hull does not float upright: its metacentric height is " +
                   rounded_text(std::min(afloat.roll_gm_m, afloat.pitch_gm_m), 3) +
                   " m; --hull-center lowers its centre of mass");
    if (coefficients_) {
        options.coefficients = coefficients_of(*launch.hull, *coefficients_);
        try {
            launch.hull = std::make_shared<const Hull>(launch.hull->mesh(), options);
        } catch (const std::invalid_argument& error) {
            throw InputError("--hull-coefficients is " + *coefficients_ + ": " + error.what());
        }
    }
    return launch;
}

}  // namespace pelagic::tools
