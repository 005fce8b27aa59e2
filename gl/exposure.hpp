// How a camera sets its exposure: what its light meter says of a view, and how that follows a view that changes.
//
// Exposure values are those of photography at ISO 100: EV 15 is a sunlit scene, EV 12 an overcast day, EV 0 a street at
// night, EV -3 a landscape under the full moon. A scene whose mean luminance is 2^EV / 8 cd/m^2 is shown as middle grey (ISO
// 2720: a reflected-light meter's constant K = 12.5).
#pragma once

#include <optional>
#include <span>

namespace pelagic::gl {

/// Illuminance of the sun above the air: Darula, Kittler and Gueymard 2005, "Reference luminous solar constant". Radiances are
/// relative to the sun's irradiance there, so this is also the luminance, in cd/m^2, that a radiance of 1 stands for.
inline constexpr float sun_illuminance_lx = 133.1e3f;

inline constexpr float min_ev = -10, max_ev = 20;
inline constexpr float max_bias_stops = 5;

/// What a user may say of the camera.
struct CameraSettings {
    std::optional<float> fixed_ev;  ///< [min_ev, max_ev]; none: metered on what is in view
    float bias_stops = 0;           ///< brighter than metered, [-max_bias_stops, max_bias_stops]; a fixed EV has none
    float bloom = 0.04f;            ///< part of each pixel's light that the lens spreads around it; [0, 1]
};

/// What the tone curve of shaders/film.glsl shows of a grey scene value, linear, [0, 1), and the value that it shows so.
float shown_by_film(float scene);
float film_input_of(float shown);

/// What radiance is multiplied with before the tone curve. \param luminance_of_unit  of a radiance of 1, cd/m^2
float exposure_of_ev(float ev, float luminance_of_unit);
float ev_of_exposure(float exposure, float luminance_of_unit);

/// A part of an image, all parts of the same size: logarithms to the base 2 of its luminance, in the image's unit.
struct MeteredCell {
    float mean_of_log2 = 0;
    float log2_of_mean = 0;
};

/// The exposure value that a view asks for:
///
///   * its log average Y is shown as middle grey (0.18; Reinhard et al. 2002, "Photographic Tone Reproduction", eq. 1), below 4000
///     cd/m^2 darker, because eyes expect dusk and night to be dark. Their key is 1.03 - 2 / (2 + log10(Y + 1)) in Krawczyk,
///     Myszkowski and Seidel 2005, "Perceptual effects in real-time tone mapping"; grey falls as a power of it, to their own
///     0.03 in the dark;
///   * but its brightest 2 % of cells are not shown as more than 0.9, up to 1.5 stops darker for that: where a glitter path
///     is, or the sun, no exposure holds both;
///   * and half of the view is not shown as less than 0.065, or as the night's part of that: what a bright sky or a glitter path
///     does to the rest has an end.
///
/// Cells that are not finite don't count; a view without light counts as 1e-5 cd/m^2.
float metered_ev(std::span<const MeteredCell> cells, float luminance_of_unit);

/// How much darker than by day a scene of that mean luminance is exposed, (0, 1].
float night_darkening(float luminance_cd_m2);

/// An exposure that follows what is metered, as eyes and cameras do: exponentially in stops, faster to a brighter view. 0.4 s:
/// Durand and Dorsey 2000, "Interactive Tone Mapping" (light adaptation of rods). Darker three times as slowly, as the
/// automatic exposure of cameras and game engines does; eyes take minutes there.
class FollowedExposure {
   public:
    static constexpr double to_brighter_s = 0.4, to_darker_s = 1.2;

    /// The first call takes the metered value over. The same at any frame rate.
    void follow(float metered, double passed_s);
    /// \pre follow() was called
    float ev() const { return *ev_; }
    bool has_ev() const { return ev_.has_value(); }

   private:
    std::optional<float> ev_;
};

}  // namespace pelagic::gl
