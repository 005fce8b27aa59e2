#include "pelagic/gl/water/water_optics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic::gl {
namespace {

constexpr std::array channels_nm = {612.f, 549.f, 465.f};

/// Jerlov's tables cover 400 to 700 nm in steps of 25 nm.
constexpr std::size_t wavelengths = 13;
constexpr float first_nm = 400, step_nm = 25;

struct JerlovType {
    std::string_view name;
    float chlorophyll_mg_per_m3;    ///< 0 where mineral particles scatter
    float scattering_at_550_per_m;  ///< scattering of mineral particles at 550 nm
    std::array<float, wavelengths> attenuation_per_m;
};

constexpr std::array types = {
    JerlovType{
        "I",
        0.01f,
        0,
        {.0217f, .0185f, .0176f, .0184f, .0280f, .0504f, .0640f, .0931f, .2408f, .3174f, .3559f, .4372f, .6513f}},
    JerlovType{
        "IA",
        0.05f,
        0,
        {.0316f, .0280f, .0257f, .0250f, .0332f, .0545f, .0674f, .0960f, .2437f, .3206f, .3601f, .4410f, .6530f}},
    JerlovType{
        "IB",
        0.1f,
        0,
        {.0438f, .0395f, .0355f, .0330f, .0396f, .0596f, .0715f, .0995f, .2471f, .3245f, .3652f, .4457f, .6550f}},
    JerlovType{
        "II",
        0.5f,
        0,
        {.0878f, .0814f, .0714f, .0620f, .0627f, .0779f, .0863f, .1122f, .2595f, .3389f, .3837f, .4626f, .6623f}},
    JerlovType{
        "III",
        1.75f,
        0,
        {.1697f, .1594f, .1381f, .1160f, .1056f, .1120f, .1139f, .1359f, .2826f, .3655f, .4181f, .4942f, .6760f}},
    JerlovType{"1C", 0, 0.372f, {.51f, .36f, .25f, .17f, .14f, .13f, .12f, .15f, .30f, .37f, .45f, .51f, .65f}},
    JerlovType{"3C", 0, 1.071f, {.78f, .54f, .39f, .29f, .22f, .20f, .19f, .21f, .33f, .40f, .46f, .56f, .71f}},
    JerlovType{"5C", 0, 1.382f, {1.1f, .78f, .56f, .43f, .36f, .31f, .30f, .33f, .40f, .48f, .54f, .65f, .80f}},
    JerlovType{"7C", 0, 2.394f, {1.6f, 1.2f, .89f, .71f, .58f, .49f, .46f, .46f, .48f, .54f, .63f, .78f, .92f}},
    JerlovType{"9C", 0, 3.18f, {2.4f, 1.9f, 1.6f, 1.23f, .99f, .78f, .63f, .58f, .60f, .65f, .76f, .92f, 1.1f}},
};

constexpr std::array names = [] {
    std::array<std::string_view, types.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = types[i].name;
    return all;
}();

/// Backscattered fraction of scattering by particles: the mean of the turbid waters of Petzold
/// 1972, "Volume scattering functions for selected ocean waters".
constexpr float petzold_backward_fraction = 0.0183f;

float attenuation_at(const JerlovType& type, float nm) {
    const float place = (nm - first_nm) / step_nm;
    const auto i = static_cast<std::size_t>(place);
    const float weight = place - static_cast<float>(i);
    return (1 - weight) * type.attenuation_per_m[i] + weight * type.attenuation_per_m[i + 1];
}

/// Returns the scattering of pure sea water, 1/m: Morel 1974, as given in Mobley 1994, "Light and
/// Water". Half of it is backscattering.
float water_scattering(float nm) { return 16.06f * 4.72e-4f * std::pow(400 / nm, 4.32f); }

struct Scattering {
    float all, backward;
};

/// Returns the scattering of case 1 water: pure water and particles that vary with chlorophyll C.
///
/// Particles scatter b = 0.416 C^0.766 at 550 nm (Loisel and Morel 1998). The backscattered
/// fraction is 0.002 + 0.01 (0.5 - 0.25 lg C) (wavelength / 550 nm)^v, v = (lg C - 0.3) / 2, at
/// most 0 (Morel and Maritorena 2001).
Scattering case_1_scattering(float chlorophyll, float nm) {
    const float logarithm = std::log10(chlorophyll);
    const float slope = std::min(0.5f * (logarithm - 0.3f), 0.f);
    const float particles = 0.416f * std::pow(chlorophyll, 0.766f);
    const float backward_fraction = 0.002f + 0.01f * (0.5f - 0.25f * logarithm) * std::pow(nm / 550, slope);
    const float water = water_scattering(nm);
    return {water + particles * std::pow(nm / 550, slope), 0.5f * water + particles * backward_fraction};
}

/// Returns the scattering of coastal water. Mineral particles scatter in inverse proportion to the
/// wavelength (Gordon and Morel 1983).
Scattering coastal_scattering(const JerlovType& type, float nm) {
    const float water = water_scattering(nm), particles = type.scattering_at_550_per_m * 550 / nm;
    return {water + particles, 0.5f * water + petzold_backward_fraction * particles};
}

float absorption_of(float attenuation_per_m, float backscattering_per_m) {
    float absorption = 0.75f * attenuation_per_m;
    for (int i = 0; i < 12; ++i) {
        const float reflectance = 0.33f * backscattering_per_m / absorption;
        absorption = attenuation_per_m * 0.9f * (1 - reflectance) / (1 + 2.25f * reflectance);
    }
    return absorption;
}

/// Absorption of pure water, 1/m, in the three channels: Pope and Fry 1997.
constexpr std::array pure_absorption_per_m = {0.267f, 0.0558f, 0.0101f};
/// Absorption of chlorophyll relative to 440 nm: Prieur and Sathyendranath 1981.
constexpr std::array chlorophyll_absorption = {0.257f, 0.363f, 0.894f};

}  // namespace

std::span<const std::string_view> jerlov_types() { return names; }

WaterOptics water_optics(std::string_view jerlov_type) {
    const auto is_it = [jerlov_type](const JerlovType& type) { return type.name == jerlov_type; };
    const auto type = std::find_if(types.begin(), types.end(), is_it);
    if (type == types.end())
        throw std::invalid_argument("water type is " + std::string(jerlov_type) +
                                    ", expected one of I, IA, IB, II, III, 1C, 3C, 5C, 7C, 9C");
    WaterOptics water;
    for (int c = 0; c < 3; ++c) {
        const float nm = channels_nm[static_cast<std::size_t>(c)];
        const Scattering scattering = type->chlorophyll_mg_per_m3 > 0
                                          ? case_1_scattering(type->chlorophyll_mg_per_m3, nm)
                                          : coastal_scattering(*type, nm);
        water.scattering_per_m[c] = scattering.all;
        water.backscattering_per_m[c] = scattering.backward;
        water.absorption_per_m[c] = absorption_of(attenuation_at(*type, nm), scattering.backward);
    }
    return water;
}

WaterOptics water_optics_of_chlorophyll(float mg_per_m3) {
    if (!(mg_per_m3 >= 0.01f && mg_per_m3 <= 30))
        throw std::invalid_argument(invalid_value_message("chlorophyll", mg_per_m3, "[0.01, 30] mg/m^3"));
    WaterOptics water;
    for (std::size_t i = 0; i < channels_nm.size(); ++i) {
        const int c = static_cast<int>(i);
        const Scattering scattering = case_1_scattering(mg_per_m3, channels_nm[i]);
        water.scattering_per_m[c] = scattering.all;
        water.backscattering_per_m[c] = scattering.backward;
        water.absorption_per_m[c] =
            (pure_absorption_per_m[i] + 0.06f * chlorophyll_absorption[i] * std::pow(mg_per_m3, 0.65f)) *
            (1 + 0.2f * std::exp(-0.014f * (channels_nm[i] - 440)));
    }
    return water;
}

}  // namespace pelagic::gl
