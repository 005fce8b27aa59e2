// Every number that a struct of the C interface holds, set to the smallest double and float values:
// either one line that names the field rejects it, or all results are finite.
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/tests/capi_sea.hpp"

namespace pelagic {
namespace {

/// The smallest double, a double whose square is 0, the smallest float, a float whose square is 0,
/// and a negative value.
constexpr std::array min_values = {5e-324, 1e-300, 1.4e-45, 1e-30, -5e-324};

template <class Struct>
struct Named {
    const char* name;
    double Struct::*member;
};

/// Records the first value that is not finite; empty if there is none.
class Findings {
   public:
    void number(const char* name, double value) {
        if (!std::isfinite(value) && what_.empty()) what_ = std::string(name) + " is " + std::to_string(value);
    }
    void floats(const char* name, const float* values, std::size_t count) {
        for (std::size_t i = 0; values && i < count; ++i) number(name, static_cast<double>(values[i]));
    }
    void halves(const char* name, const std::uint16_t* values, std::size_t count) {
        for (std::size_t i = 0; values && i < count; ++i)
            if ((values[i] & 0x7c00) == 0x7c00) number(name, INFINITY);
    }
    void plane(const char* name, const pelagic_plane& plane) {
        for (int j = 0; plane.data && j < plane.resolution; ++j)
            for (int i = 0; i < plane.resolution; ++i) number(name, static_cast<double>(texel_of(plane, i, j)));
    }
    void bounds(const pelagic_bounds& bounds) {
        for (const float bound :
             {bounds.height_min_m, bounds.height_max_m, bounds.horizontal_x_max_m, bounds.horizontal_z_max_m})
            number("bound", static_cast<double>(bound));
    }
    const std::string& what() const { return what_; }

   private:
    std::string what_;
};

void look_at(const pelagic_cascade& cascade, Findings& found) {
    const auto texels = static_cast<std::size_t>(cascade.resolution) * static_cast<std::size_t>(cascade.resolution);
    for (const pelagic_plane* plane :
         {&cascade.dx, &cascade.height, &cascade.dz, &cascade.velocity_x, &cascade.velocity_y, &cascade.velocity_z})
        found.plane("plane", *plane);
    found.halves("half", cascade.displacement_rgba16f, 4 * texels);
    found.bounds(cascade.bounds);
    found.number("side_m", cascade.side_m);
    for (const float number : {cascade.slope_range, cascade.variance_range, cascade.compression_scale,
                               cascade.compression_front_x, cascade.compression_front_z})
        found.number("figure of a cascade", static_cast<double>(number));
}

void look_at(const pelagic_dynamic_waves_view& dynamic_waves, Findings& found) {
    const auto texels =
        static_cast<std::size_t>(dynamic_waves.resolution) * static_cast<std::size_t>(dynamic_waves.resolution);
    found.floats("dynamic waves height", dynamic_waves.height_m, texels);
    found.floats("dynamic waves vertical velocity", dynamic_waves.vertical_velocity_mps, texels);
    found.number("dynamic waves texel", dynamic_waves.texel_m);
    found.number("dynamic waves bound", static_cast<double>(dynamic_waves.height_min_m));
    found.number("dynamic waves bound", static_cast<double>(dynamic_waves.height_max_m));
}

void look_at(const pelagic_shore_surface& shore, Findings& found) {
    const auto texels = static_cast<std::size_t>(shore.columns) * static_cast<std::size_t>(shore.rows);
    found.floats("shore depth", shore.depth_m, texels);
    found.floats("shore height", shore.height_m, texels);
    found.floats("shore rise", shore.vertical_velocity_mps, texels);
    found.floats("shore reach", shore.reach_m, texels);
    found.number("shore texel", shore.texel_m);
    found.number("weights_change_per_m", static_cast<double>(shore.weights_change_per_m));
}

/// Frames at several times, all of their outputs, and queries of them.
std::string first_non_finite(pelagic_ocean* ocean, const pelagic_ocean_options& options) {
    Findings found;
    for (const double time_s : {0.0, 0.02, 0.3, 1.1}) {
        pelagic_frame frame{};
        if (pelagic_ocean_schedule(ocean, time_s) != PELAGIC_OK ||
            pelagic_ocean_complete(ocean, &frame) != PELAGIC_OK)
            return std::string("a frame failed: ") + pelagic_last_error();
        found.bounds(frame.bounds);
        found.number("roughness", static_cast<double>(frame.roughness));
        found.number("foam_drift_x_mps", frame.foam_drift_x_mps);
        found.number("foam_drift_z_mps", frame.foam_drift_z_mps);
        for (int i = 0; i < frame.cascade_count; ++i) {
            pelagic_cascade cascade{};
            EXPECT_EQ(pelagic_ocean_cascade(ocean, i, &cascade), PELAGIC_OK);
            look_at(cascade, found);
        }
        if (options.dynamic_waves) {
            pelagic_dynamic_waves_view dynamic_waves{};
            EXPECT_EQ(pelagic_dynamic_waves_get_view(waves_of(ocean), &dynamic_waves), PELAGIC_OK);
            look_at(dynamic_waves, found);
        }
        if (options.shore) {
            pelagic_shore_surface shore{};
            EXPECT_EQ(pelagic_ocean_shore(ocean, &shore), PELAGIC_OK);
            look_at(shore, found);
        }
        const std::array<double, 3> x = {0, 7.3, -41}, z = {0, -3.1, 55};
        std::array<std::array<float, 3>, 8> out{};
        std::array<std::uint8_t, 3> converged{};
        auto points = pelagic_points_make();
        points.count = x.size();
        points.x = x.data();
        points.z = z.data();
        auto samples = pelagic_samples_make();
        samples.height_m = out[0].data();
        samples.normal_x = out[1].data();
        samples.normal_y = out[2].data();
        samples.normal_z = out[3].data();
        samples.jacobian = out[4].data();
        samples.velocity_x_mps = out[5].data();
        samples.velocity_y_mps = out[6].data();
        samples.velocity_z_mps = out[7].data();
        samples.converged = converged.data();
        EXPECT_EQ(pelagic_ocean_query(ocean, &points, &samples), PELAGIC_OK) << pelagic_last_error();
        for (const auto& values : out) found.floats("sample", values.data(), values.size());
    }
    return found.what();
}

void expect_rejection_naming(pelagic_status status, const std::string& what, const char* name) {
    const std::string line = pelagic_last_error();
    EXPECT_EQ(status, PELAGIC_INVALID_ARGUMENT) << what << ": " << line;
    EXPECT_NE(line.find(name), std::string::npos) << what << ": " << line;
    EXPECT_TRUE(line.find(", expected ") != line.npos || line.find(" is out of range ") != line.npos)
        << what << ": " << line;
}

using Make = std::function<pelagic_status(pelagic_ocean** ocean)>;

/// \pre `options` are accepted by make()
void expect_rejected_or_finite(const std::string& what, const char* name, const pelagic_ocean_options& options,
                               const Make& make) {
    pelagic_ocean* made = nullptr;
    const pelagic_status status = make(&made);
    const COcean ocean(made);
    if (status != PELAGIC_OK) return expect_rejection_naming(status, what, name);
    EXPECT_EQ(first_non_finite(ocean.get(), options), "") << what;
}

/// Each field is set to each of `min_values`; the others are unchanged.
template <class Struct, std::size_t count, class Try>
void walk(const Struct& all, const Named<Struct> (&fields)[count], const std::string& which, Try attempt) {
    for (const auto& field : fields)
        for (const double value : min_values) {
            Struct changed = all;
            changed.*field.member = value;
            char text[40];
            std::snprintf(text, sizeof text, "%g", value);
            attempt(changed, which + ": " + field.name + " = " + text, field.name);
        }
}

pelagic_ocean_options all_options() {
    static const COceanExecutor serial = executor_of(PELAGIC_EXECUTOR_SERIAL);
    auto options = pelagic_ocean_options_make();
    options.executor = serial.get();
    options.queries = options.velocities = options.slopes = options.gradients = options.foam = 1;
    return options;
}

constexpr Named<pelagic_sea> sea_fields[] = {{"patch_size_m", &pelagic_sea::patch_size_m},
                                             {"wind_speed_mps", &pelagic_sea::wind_speed_mps},
                                             {"wind_direction_rad", &pelagic_sea::wind_direction_rad},
                                             {"fetch_m", &pelagic_sea::fetch_m},
                                             {"depth_m", &pelagic_sea::depth_m},
                                             {"choppiness", &pelagic_sea::choppiness},
                                             {"lean", &pelagic_sea::lean},
                                             {"roughness", &pelagic_sea::roughness},
                                             {"short_wave_cutoff", &pelagic_sea::short_wave_cutoff},
                                             {"wind_alignment", &pelagic_sea::wind_alignment},
                                             {"loop_period_s", &pelagic_sea::loop_period_s},
                                             {"swell_height_m", &pelagic_sea::swell_height_m},
                                             {"swell_period_s", &pelagic_sea::swell_period_s},
                                             {"swell_direction_rad", &pelagic_sea::swell_direction_rad},
                                             {"swell_spread_rad", &pelagic_sea::swell_spread_rad},
                                             {"longest_wave_m", &pelagic_sea::longest_wave_m},
                                             {"shortest_wave_m", &pelagic_sea::shortest_wave_m},
                                             {"wave_strength", &pelagic_sea::wave_strength},
                                             {"wave_height_m", &pelagic_sea::wave_height_m},
                                             {"wave_drag", &pelagic_sea::wave_drag},
                                             {"regular_height_m", &pelagic_sea::regular_height_m},
                                             {"regular_period_s", &pelagic_sea::regular_period_s}};

struct Kind {
    const char* name;
    std::int32_t waves, spectrum, spreading;
    bool has_side = false;  ///< its patch_size_m is given
    double swell_height_m = 0;
};
constexpr Kind kinds[] = {
    {"jonswap", PELAGIC_WAVES_SPECTRUM, PELAGIC_SPECTRUM_JONSWAP, PELAGIC_SPREADING_HASSELMANN, false, 1.5},
    {"pierson-moskowitz", PELAGIC_WAVES_SPECTRUM, PELAGIC_SPECTRUM_PIERSON_MOSKOWITZ, PELAGIC_SPREADING_COSINE_2S},
    {"phillips", PELAGIC_WAVES_SPECTRUM, PELAGIC_SPECTRUM_PHILLIPS, PELAGIC_SPREADING_DONELAN_BANNER, true},
    {"phillips-paper", PELAGIC_WAVES_SPECTRUM, PELAGIC_SPECTRUM_PHILLIPS_PAPER, PELAGIC_SPREADING_PAPER, true},
    {"analytic", PELAGIC_WAVES_ANALYTIC, PELAGIC_SPECTRUM_JONSWAP, PELAGIC_SPREADING_PAPER},
    {"pond", PELAGIC_WAVES_POND, PELAGIC_SPECTRUM_JONSWAP, PELAGIC_SPREADING_PAPER},
    {"regular", PELAGIC_WAVES_REGULAR, PELAGIC_SPECTRUM_JONSWAP, PELAGIC_SPREADING_PAPER}};

pelagic_sea sea_of(const Kind& kind) {
    auto sea = pelagic_sea_make();
    sea.waves = kind.waves;
    sea.spectrum = kind.spectrum;
    sea.spreading = kind.spreading;
    sea.swell_height_m = kind.swell_height_m;
    sea.resolution = 32;
    if (kind.has_side) sea.patch_size_m = 100;
    return sea;
}

pelagic_sea two_cascades() { return stack_sea(2); }

TEST(CInterfaceSmallestValues, FieldsOfASeaAreRejectedOrFinite) {
    const pelagic_ocean_options options = all_options();
    for (const Kind& kind : kinds)
        walk(sea_of(kind), sea_fields, kind.name,
             [&](const pelagic_sea& sea, const std::string& what, const char* name) {
                 expect_rejected_or_finite(what, name, options, [&](pelagic_ocean** ocean) {
                     return pelagic_ocean_create(&sea, &options, ocean);
                 });
             });
}

TEST(CInterfaceSmallestValues, QueryToleranceIsRejectedOrFinite) {
    constexpr Named<pelagic_ocean_options> fields[] = {
        {"query_tolerance_m", &pelagic_ocean_options::query_tolerance_m}};
    const pelagic_sea sea = two_cascades();
    walk(all_options(), fields, "options",
         [&](const pelagic_ocean_options& options, const std::string& what, const char* name) {
             expect_rejected_or_finite(what, name, options, [&](pelagic_ocean** ocean) {
                 return pelagic_ocean_create(&sea, &options, ocean);
             });
         });
}

TEST(CInterfaceSmallestValues, FieldsOfATransitionAreRejectedOrFinite) {
    constexpr Named<pelagic_change> fields[] = {{"from_s", &pelagic_change::from_s},
                                                {"over_s", &pelagic_change::over_s},
                                                {"swell_from_m", &pelagic_change::swell_from_m}};
    const pelagic_ocean_options options = all_options();
    const pelagic_sea first = two_cascades();
    pelagic_sea later = first;
    later.wind_direction_rad = 1;
    later.swell_height_m = 1;
    auto usual = pelagic_change_make();
    usual.sea = &later;
    usual.from_s = 0.1;
    usual.over_s = 1;
    const auto of_forecast = [&](const pelagic_forecast& forecast, const std::string& what, const char* name) {
        expect_rejected_or_finite(what, name, options, [&](pelagic_ocean** ocean) {
            return pelagic_ocean_create_forecast(&forecast, &options, ocean);
        });
    };
    auto forecast = pelagic_forecast_make();
    forecast.first = &first;
    forecast.change_count = 1;
    walk(usual, fields, "change", [&](const pelagic_change& change, const std::string& what, const char* name) {
        forecast.changes = &change;
        of_forecast(forecast, what, name);
    });
    forecast.changes = &usual;
    constexpr Named<pelagic_forecast> peak[] = {{"largest_peak_m", &pelagic_forecast::largest_peak_m}};
    walk(forecast, peak, "forecast", of_forecast);
}

pelagic_dynamic_waves_options dynamic_waves_options(std::int32_t step) {
    auto dynamic_waves = pelagic_dynamic_waves_options_make();
    dynamic_waves.resolution = 64;
    dynamic_waves.step = step;
    return dynamic_waves;
}

pelagic_disturbance splash(std::int32_t mode, std::int32_t shape) {
    auto disturbance = pelagic_disturbance_make();
    disturbance.mode = mode;
    disturbance.shape = shape;
    disturbance.radius_m = 3;
    disturbance.length_m = 5;
    disturbance.height_m = 0.3;
    return disturbance;
}

constexpr std::int32_t steps[] = {PELAGIC_DYNAMIC_WAVES_SPECTRAL, PELAGIC_DYNAMIC_WAVES_VERLET};

TEST(CInterfaceSmallestValues, FieldsOfDynamicWavesAreRejectedOrFinite) {
    constexpr Named<pelagic_dynamic_waves_options> fields[] = {
        {"side_m", &pelagic_dynamic_waves_options::side_m},
        {"border_m", &pelagic_dynamic_waves_options::border_m},
        {"depth_m", &pelagic_dynamic_waves_options::depth_m},
        {"viscosity_m2ps", &pelagic_dynamic_waves_options::viscosity_m2ps},
        {"wave_speed_mps", &pelagic_dynamic_waves_options::wave_speed_mps},
        {"decay_per_s", &pelagic_dynamic_waves_options::decay_per_s},
        {"foam_height_m", &pelagic_dynamic_waves_options::foam_height_m}};
    const pelagic_sea sea = two_cascades();
    const pelagic_disturbance push = splash(PELAGIC_DISTURBANCE_PRESSURE, PELAGIC_SHAPE_GAUSS);
    for (const std::int32_t step : steps)
        walk(dynamic_waves_options(step), fields, step == PELAGIC_DYNAMIC_WAVES_VERLET ? "Verlet" : "spectral",
             [&](const pelagic_dynamic_waves_options& dynamic_waves, const std::string& what, const char* name) {
                 pelagic_ocean_options options = all_options();
                 options.dynamic_waves = &dynamic_waves;
                 expect_rejected_or_finite(what, name, options, [&](pelagic_ocean** ocean) {
                     const pelagic_status status = pelagic_ocean_create(&sea, &options, ocean);
                     return status == PELAGIC_OK ? pelagic_dynamic_waves_add_impulse(waves_of(*ocean), &push)
                                                 : status;
                 });
             });
}

TEST(CInterfaceSmallestValues, FieldsOfADisturbanceAreRejectedOrFinite) {
    constexpr Named<pelagic_disturbance> fields[] = {{"x_m", &pelagic_disturbance::x_m},
                                                     {"z_m", &pelagic_disturbance::z_m},
                                                     {"radius_m", &pelagic_disturbance::radius_m},
                                                     {"length_m", &pelagic_disturbance::length_m},
                                                     {"heading_rad", &pelagic_disturbance::heading_rad},
                                                     {"height_m", &pelagic_disturbance::height_m},
                                                     {"rate_per_s", &pelagic_disturbance::rate_per_s},
                                                     {"velocity_x_mps", &pelagic_disturbance::velocity_x_mps},
                                                     {"velocity_z_mps", &pelagic_disturbance::velocity_z_mps}};
    const pelagic_sea sea = two_cascades();
    for (const std::int32_t step : steps) {
        const pelagic_dynamic_waves_options dynamic_waves = dynamic_waves_options(step);
        pelagic_ocean_options options = all_options();
        options.dynamic_waves = &dynamic_waves;
        const COcean ocean = ocean_of(sea, options);
        for (const std::int32_t mode : {PELAGIC_DISTURBANCE_PRESSURE, PELAGIC_DISTURBANCE_RELAXATION,
                                        PELAGIC_DISTURBANCE_IMPULSE, PELAGIC_DISTURBANCE_FOAM})
            for (const std::int32_t shape : {PELAGIC_SHAPE_GAUSS, PELAGIC_SHAPE_HULL})
                walk(splash(mode, shape), fields,
                     "step " + std::to_string(step) + ", mode " + std::to_string(mode) + ", shape " +
                         std::to_string(shape),
                     [&](const pelagic_disturbance& source, const std::string& what, const char* name) {
                         std::uint32_t number = 0;
                         const pelagic_status status =
                             pelagic_dynamic_waves_add_source(waves_of(ocean.get()), &source, &number);
                         if (status != PELAGIC_OK) return expect_rejection_naming(status, what, name);
                         EXPECT_EQ(first_non_finite(ocean.get(), options), "") << what;
                         EXPECT_EQ(pelagic_dynamic_waves_remove_source(waves_of(ocean.get()), number), PELAGIC_OK);
                     });
    }
}

TEST(CInterfaceSmallestValues, FieldsOfRainAreRejectedOrFinite) {
    constexpr Named<pelagic_rain> fields[] = {{"drops_per_m2_s", &pelagic_rain::drops_per_m2_s},
                                              {"radius_m", &pelagic_rain::radius_m},
                                              {"height_m", &pelagic_rain::height_m}};
    const pelagic_sea sea = two_cascades();
    auto usual = pelagic_rain_make();
    usual.drops_per_m2_s = 1;
    for (const std::int32_t step : steps) {
        const pelagic_dynamic_waves_options dynamic_waves = dynamic_waves_options(step);
        pelagic_ocean_options options = all_options();
        options.dynamic_waves = &dynamic_waves;
        const COcean ocean = ocean_of(sea, options);
        walk(usual, fields, "step " + std::to_string(step),
             [&](const pelagic_rain& rain, const std::string& what, const char* name) {
                 const pelagic_status status = pelagic_dynamic_waves_set_rain(waves_of(ocean.get()), &rain);
                 if (status != PELAGIC_OK) return expect_rejection_naming(status, what, name);
                 EXPECT_EQ(first_non_finite(ocean.get(), options), "") << what;
             });
    }
}

TEST(CInterfaceSmallestValues, FieldsOfAShoreAreRejectedOrFinite) {
    constexpr Named<pelagic_shore_options> fields[] = {
        {"corner_x_m", &pelagic_shore_options::corner_x_m},
        {"corner_z_m", &pelagic_shore_options::corner_z_m},
        {"metres_per_sample", &pelagic_shore_options::metres_per_sample},
        {"fade_m", &pelagic_shore_options::fade_m},
        {"swash_m", &pelagic_shore_options::swash_m}};
    const pelagic_sea sea = two_cascades();
    auto usual = pelagic_shore_options_make();
    usual.columns = usual.rows = 17;
    usual.resolution = 64;
    usual.metres_per_sample = 10;
    usual.corner_x_m = usual.corner_z_m = -70;
    for (const float sign : {1.f, 0.f}) {  // a beach whose heights also include the smallest values
        std::vector<float> heights;
        for (int j = 0; j < usual.rows; ++j)
            for (int i = 0; i < usual.columns; ++i)
                heights.push_back(sign > 0 ? static_cast<float>(i - 12) : i % 2 ? -1.4e-45f : 1.4e-45f);
        usual.heights_m = heights.data();
        walk(usual, fields, sign > 0 ? "beach" : "no depth",
             [&](const pelagic_shore_options& shore, const std::string& what, const char* name) {
                 pelagic_ocean_options options = all_options();
                 options.shore = &shore;
                 expect_rejected_or_finite(what, name, options, [&](pelagic_ocean** ocean) {
                     return pelagic_ocean_create(&sea, &options, ocean);
                 });
             });
    }
}

// The smallest accepted values also give finite frames.
TEST(CInterfaceSmallestValues, SmallestAcceptedValuesGiveFiniteFrames) {
    const pelagic_sea sea = two_cascades();
    std::vector<float> heights(9, -1);
    heights[4] = 1;
    auto shore = pelagic_shore_options_make();
    shore.columns = shore.rows = 3;
    shore.resolution = 64;
    shore.heights_m = heights.data();
    shore.metres_per_sample = 0.001;
    for (const std::int32_t step : steps) {
        pelagic_dynamic_waves_options dynamic_waves = dynamic_waves_options(step);
        dynamic_waves.border_m = dynamic_waves.foam_height_m = 0.001;
        pelagic_ocean_options options = all_options();
        options.dynamic_waves = &dynamic_waves;
        options.shore = &shore;
        const COcean ocean = ocean_of(sea, options);
        pelagic_disturbance stone = splash(PELAGIC_DISTURBANCE_IMPULSE, PELAGIC_SHAPE_HULL);
        stone.radius_m = stone.length_m = 0.001;
        auto rain = pelagic_rain_make();
        rain.drops_per_m2_s = 1;
        rain.radius_m = 0.001;
        EXPECT_EQ(pelagic_dynamic_waves_add_impulse(waves_of(ocean.get()), &stone), PELAGIC_OK)
            << pelagic_last_error();
        EXPECT_EQ(pelagic_dynamic_waves_set_rain(waves_of(ocean.get()), &rain), PELAGIC_OK) << pelagic_last_error();
        EXPECT_EQ(first_non_finite(ocean.get(), options), "") << "step " << step;
    }
}

/// An ocean with `input` as its only wave input.
pelagic_status ocean_with_input(pelagic_status status, pelagic_input* input, const pelagic_ocean_options& options,
                                pelagic_ocean** ocean) {
    if (status != PELAGIC_OK) return status;
    const pelagic_sea sea = two_cascades();
    pelagic_ocean_options with = options;
    with.input_count = 1;
    with.inputs = &input;
    status = pelagic_ocean_create(&sea, &with, ocean);
    pelagic_input_destroy(input);
    return status;
}

TEST(CInterfaceSmallestValues, FieldsOfARippleAreRejectedOrFinite) {
    constexpr Named<pelagic_ripple> fields[] = {{"x_m", &pelagic_ripple::x_m},
                                                {"z_m", &pelagic_ripple::z_m},
                                                {"wavelength_m", &pelagic_ripple::wavelength_m},
                                                {"amplitude_m", &pelagic_ripple::amplitude_m},
                                                {"reach_m", &pelagic_ripple::reach_m},
                                                {"phase_rad", &pelagic_ripple::phase_rad}};
    auto usual = pelagic_ripple_make();
    usual.wavelength_m = 20;
    usual.amplitude_m = 0.5;
    usual.reach_m = 50;
    const pelagic_ocean_options options = all_options();
    walk(usual, fields, "ripple", [&](const pelagic_ripple& ripple, const std::string& what, const char* name) {
        expect_rejected_or_finite(what, name, options, [&](pelagic_ocean** ocean) {
            pelagic_input* input = nullptr;
            const pelagic_status status = pelagic_input_create_ripple(&ripple, &input);
            return ocean_with_input(status, input, options, ocean);
        });
    });
}

struct Wave {
    double amplitude_m = 0.3, wavelength_m = 20, direction_rad = 1, phase_rad = 1, choppiness = 1;
};

TEST(CInterfaceSmallestValues, FieldsOfAWaveListAreRejectedOrFinite) {
    constexpr Named<Wave> fields[] = {{"amplitude_m", &Wave::amplitude_m},
                                      {"wavelength_m", &Wave::wavelength_m},
                                      {"direction_rad", &Wave::direction_rad},
                                      {"phase_rad", &Wave::phase_rad},
                                      {"choppiness", &Wave::choppiness}};
    const pelagic_ocean_options options = all_options();
    walk(Wave(), fields, "waves", [&](const Wave& wave, const std::string& what, const char* name) {
        auto waves = pelagic_waves_make();
        waves.count = 1;
        waves.amplitude_m = &wave.amplitude_m;
        waves.wavelength_m = &wave.wavelength_m;
        waves.direction_rad = &wave.direction_rad;
        waves.phase_rad = &wave.phase_rad;
        waves.choppiness = wave.choppiness;
        expect_rejected_or_finite(what, name, options, [&](pelagic_ocean** ocean) {
            pelagic_input* input = nullptr;
            const pelagic_status status = pelagic_input_create_waves(&waves, &input);
            return ocean_with_input(status, input, options, ocean);
        });
    });
}

TEST(CInterfaceSmallestValues, SlopeBoundOfACallbackIsRejectedOrFinite) {
    constexpr Named<pelagic_input_callback> fields[] = {{"largest_slope", &pelagic_input_callback::largest_slope}};
    auto usual = pelagic_input_callback_make();
    usual.add = [](void*, const pelagic_input_rows* rows) { rows->height[0] = 1e-30f; };
    const pelagic_ocean_options options = all_options();
    walk(usual, fields, "callback",
         [&](const pelagic_input_callback& callback, const std::string& what, const char* name) {
             expect_rejected_or_finite(what, name, options, [&](pelagic_ocean** ocean) {
                 pelagic_input* input = nullptr;
                 const pelagic_status status = pelagic_input_create_callback(&callback, &input);
                 return ocean_with_input(status, input, options, ocean);
             });
         });
}

TEST(CInterfaceSmallestValues, TimesAndPositionsAreRejectedOrFinite) {
    const pelagic_dynamic_waves_options dynamic_waves = dynamic_waves_options(PELAGIC_DYNAMIC_WAVES_SPECTRAL);
    pelagic_ocean_options options = all_options();
    options.dynamic_waves = &dynamic_waves;
    const COcean ocean = ocean_of(two_cascades(), options);
    for (const double value : min_values) {
        pelagic_frame frame{};
        EXPECT_EQ(pelagic_dynamic_waves_set_center(waves_of(ocean.get()), value, value), PELAGIC_OK);
        EXPECT_EQ(pelagic_ocean_schedule(ocean.get(), value), PELAGIC_OK);
        EXPECT_EQ(pelagic_ocean_complete(ocean.get(), &frame), PELAGIC_OK);
        EXPECT_EQ(first_non_finite(ocean.get(), options), "");
        for (std::size_t number = 0; number < 7; ++number) {
            auto ray = pelagic_ray_make();
            ray.origin_m[1] = 20;
            ray.direction[1] = -1;
            ray.reach_m = 100;
            (number < 3 ? ray.origin_m[number] : number < 6 ? ray.direction[number - 3] : ray.reach_m) = value;
            pelagic_hit hit{};
            if (pelagic_ocean_first_hit(ocean.get(), &ray, &hit) != PELAGIC_OK) continue;
            Findings found;
            found.number("distance_m", hit.distance_m);
            for (const double at : hit.position_m) found.number("position_m", at);
            for (const float at : hit.normal) found.number("normal", static_cast<double>(at));
            EXPECT_EQ(found.what(), "") << "number " << number << " of the ray is " << value;
        }
    }
}

/// Adds a body to waves of its own and returns the first number of its state that is not finite
/// after some ticks.
std::string first_non_finite(const pelagic_hull* hull, const pelagic_hull_state& from) {
    const pelagic_dynamic_waves_options dynamic_waves = dynamic_waves_options(PELAGIC_DYNAMIC_WAVES_SPECTRAL);
    pelagic_ocean_options options = all_options();
    options.foam = 0;
    options.depth = 1;
    options.dynamic_waves = &dynamic_waves;
    const COcean ocean = ocean_of(small_sea(), options);
    auto with_wakes = pelagic_bodies_options_make();
    with_wakes.wakes = 1;
    with_wakes.executor = options.executor;
    pelagic_bodies* bodies = nullptr;
    std::uint32_t number = 0;
    EXPECT_EQ(pelagic_bodies_create(ocean.get(), &with_wakes, &bodies), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(pelagic_bodies_add(bodies, hull, &from, &number), PELAGIC_OK) << pelagic_last_error();
    for (int tick = 0; tick < 4; ++tick) {
        pelagic_frame frame{};
        EXPECT_EQ(pelagic_ocean_schedule(ocean.get(), tick / 60.0), PELAGIC_OK);
        EXPECT_EQ(pelagic_ocean_complete(ocean.get(), &frame), PELAGIC_OK);
        EXPECT_EQ(pelagic_bodies_press(bodies, 1 / 60.0), PELAGIC_OK) << pelagic_last_error();
        EXPECT_EQ(pelagic_bodies_step(bodies, 1 / 60.0, nullptr), PELAGIC_OK) << pelagic_last_error();
    }
    Findings found;
    pelagic_hull_state state{};
    pelagic_hull_loads loads{};
    EXPECT_EQ(pelagic_bodies_get_state(bodies, number, &state), PELAGIC_OK);
    EXPECT_EQ(pelagic_bodies_get_loads(bodies, number, &loads), PELAGIC_OK);
    for (const auto& vector : {state.position_m, state.velocity_mps, state.angular_velocity_radps,
                               loads.total.force_n, loads.total.torque_nm})
        for (int axis = 0; axis < 3; ++axis) found.number("state", vector[axis]);
    for (const double part : state.orientation) found.number("orientation", part);
    pelagic_bodies_destroy(bodies);
    return found.what();
}

TEST(CInterfaceSmallestValues, FieldsOfHullsAreRejectedOrFinite) {
    constexpr Named<pelagic_hull_options> fields[] = {
        {"mass_kg", &pelagic_hull_options::mass_kg},
        {"heave_damping", &pelagic_hull_options::heave_damping},
        {"roll_damping", &pelagic_hull_options::roll_damping},
        {"pressure_coefficient", &pelagic_hull_options::pressure_coefficient},
        {"suction_coefficient", &pelagic_hull_options::suction_coefficient},
        {"friction_coefficient", &pelagic_hull_options::friction_coefficient},
        {"air_coefficient", &pelagic_hull_options::air_coefficient},
        {"water_density_kgpm3", &pelagic_hull_options::water_density_kgpm3},
        {"air_density_kgpm3", &pelagic_hull_options::air_density_kgpm3},
        {"skeg_m2", &pelagic_hull_options::skeg_m2},
        {"skeg_x_m", &pelagic_hull_options::skeg_x_m},
        {"skeg_y_m", &pelagic_hull_options::skeg_y_m}};
    auto usual = pelagic_hull_options_make();
    if (!has_hulls()) GTEST_SKIP() << pelagic_last_error();
    usual.mass_kg = 80;
    const double vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::uint32_t triangles[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    auto mesh = pelagic_hull_mesh_make();
    mesh.vertex_count = mesh.triangle_count = 4;
    mesh.vertices_m = vertices;
    mesh.triangles = triangles;
    pelagic_hull* hull = nullptr;
    const auto try_options = [&](const pelagic_hull_options& options, const std::string& what, const char* name) {
        const pelagic_status status = pelagic_hull_create(&mesh, &options, &hull);
        if (status != PELAGIC_OK) return expect_rejection_naming(status, what, name);
        pelagic_hull_state state{};
        EXPECT_EQ(pelagic_hull_at_rest(hull, 0, 0, 0, &state), PELAGIC_OK);
        EXPECT_EQ(first_non_finite(hull, state), "") << what;
        pelagic_hull_destroy(hull);
    };
    walk(usual, fields, "options", try_options);
    for (const double value : min_values) {
        const std::vector<double> of_all(36, value);
        pelagic_hull_options options = usual;
        options.centre_of_mass_m = of_all.data();
        try_options(options, "centre of mass", "centre_of_mass_m");
        options = usual, options.inertia_kgm2 = of_all.data();
        try_options(options, "inertia", "inertia_kgm2");
        options = usual, options.added_mass = of_all.data();
        try_options(options, "added mass", "added_mass");
    }
    ASSERT_EQ(pelagic_hull_create(&mesh, &usual, &hull), PELAGIC_OK);
    for (const double value : min_values) {
        pelagic_hull_state state{};
        ASSERT_EQ(pelagic_hull_at_rest(hull, value, value, value, &state), PELAGIC_OK);
        state.velocity_mps[0] = state.angular_velocity_radps[1] = value;
        EXPECT_EQ(first_non_finite(hull, state), "") << value;
    }
    pelagic_hull_destroy(hull);
}

}  // namespace
}  // namespace pelagic
