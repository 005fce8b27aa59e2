// Automatic exposure: computes the exposure value of a metered view, and adapts it over time.
//
// Exposure values are those of photography at ISO 100: EV 15 is a sunlit scene, EV 12 an overcast
// day, EV 0 a street at night, EV -3 a landscape under the full moon. A scene whose mean luminance
// is 2^EV / 8 cd/m^2 is shown as middle grey (ISO 2720: K = 12.5 for a reflected-light meter).
#pragma once

#include <optional>
#include <span>

namespace pelagic::gl {

/// Illuminance of the sun above the atmosphere: Darula, Kittler and Gueymard 2005, "Reference
/// luminous solar constant". Radiances are relative to the sun's irradiance above the atmosphere.
/// This constant is therefore also the luminance, in cd/m^2, of a radiance of 1.
inline constexpr float sun_illuminance_lx = 133.1e3f;

inline constexpr float min_ev = -10, max_ev = 20;
inline constexpr float max_bias_stops = 5;

/// Camera settings that a user can change.
struct CameraSettings {
    std::optional<float> fixed_ev;  ///< [min_ev, max_ev]; if empty, the exposure is metered
    /// Stops brighter than metered, [-max_bias_stops, max_bias_stops]. Ignored if fixed_ev is set.
    float bias_stops = 0;
    float bloom = 0.04f;  ///< fraction of each pixel's light that the lens spreads; [0, 1]
};

/// Returns the tone curve of shaders/film.glsl for a grey scene value: linear, [0, 1).
float shown_by_film(float scene);
/// Returns the scene value for which shown_by_film() returns `shown`.
float film_input_of(float shown);

/// Returns the factor that multiplies radiance before the tone curve.
/// \param ev  exposure value
/// \param luminance_of_unit  luminance of a radiance of 1, cd/m^2
float exposure_of_ev(float ev, float luminance_of_unit);
/// Inverse of exposure_of_ev().
float ev_of_exposure(float exposure, float luminance_of_unit);

/// Base-2 logarithms of the luminance of one metering cell, in the image's unit. All cells of an
/// image have equal size.
struct MeteredCell {
    float mean_of_log2 = 0;
    float log2_of_mean = 0;
};

/// Computes the exposure value of a view from four rules:
///
///   * The log average Y of the view is shown as middle grey (0.18; Reinhard et al. 2002,
///     "Photographic Tone Reproduction", eq. 1). Below 4000 cd/m^2 the image is darker, because
///     eyes expect dusk and night to be dark. The key is 1.03 - 2 / (2 + log10(Y + 1)) in Krawczyk,
///     Myszkowski and Seidel 2005, "Perceptual effects in real-time tone mapping". The grey level
///     falls as a power of that key, down to that paper's 0.03 in the dark.
///   * The brightest 2 % of the cells are shown as at most 0.9. This rule darkens the image by at
///     most 1.5 stops: no exposure suits both the view and a glitter path or the sun.
///   * Half of the view is shown as at least 0.065, multiplied at night by night_darkening(). This
///     rule limits how far a bright sky or a glitter path darkens the remaining view.
///   * Three quarters of the view are shown as at least 0.035, multiplied likewise. This rule
///     brightens the image by at most a stop: dark water stays readable below a bright sky.
///
/// Cells that are not finite are ignored. The log average is at least 1e-5 cd/m^2.
/// \param luminance_of_unit  luminance of a radiance of 1, cd/m^2
/// \return exposure value in [min_ev, max_ev]
float metered_ev(std::span<const MeteredCell> cells, float luminance_of_unit);

/// Returns the exposure of a scene of that mean luminance relative to a daylight exposure, (0, 1].
float night_darkening(float luminance_cd_m2);

/// An exposure that adapts to the metered value exponentially in stops, faster towards a brighter
/// view. The time constant of 0.4 s is from Durand and Dorsey 2000, "Interactive Tone Mapping"
/// (light adaptation of rods). Adaptation to a darker view is three times as slow, as in the
/// automatic exposure of cameras and game engines. Eyes take minutes to adapt to the dark.
class FollowedExposure {
   public:
    static constexpr double to_brighter_s = 0.4, to_darker_s = 1.2;

    /// Moves the exposure value towards `metered`. The first call sets it to `metered`. The result
    /// does not depend on the frame rate.
    /// \param metered  exposure value from metered_ev()
    /// \param passed_s  time since the last call, s; a negative time counts as 0
    void follow(float metered, double passed_s);
    /// \pre follow() was called
    float ev() const { return *ev_; }
    /// Returns whether follow() was called.
    bool has_ev() const { return ev_.has_value(); }

   private:
    std::optional<float> ev_;
};

}  // namespace pelagic::gl
