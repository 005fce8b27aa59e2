// What a pixel of the sea or the sky becomes: a colour for the screen, or radiance for a display pass.
#include "film.glsl"

// Where radiance is asked for with weights, a sample counts for less the brighter it is, or glints on edges would stay
// jagged: samples are averaged before the tone curve (Karis 2013, "Tone Mapping"). The weight is the alpha by which the
// display pass divides. It is no less than a half float's smallest normal numbers can hold.
vec4 screen_colour(vec3 radiance) {
    if (output_kind.y > 0.5) {
        vec3 held = min(radiance, vec3(6e4));
        float weight = 1.0 / (1.0 + min(output_kind.z * luminance_of(held), 1023.0));
        return vec4(held * weight, weight);
    }
    vec3 shown = filmic(night_vision(radiance, output_kind.w) * sun_irradiance.w);
    if (output_kind.x > 0.5) shown = srgb_encoded(shown) + dither(gl_FragCoord.xy) / 255.0;
    return vec4(shown, 1.0);
}
