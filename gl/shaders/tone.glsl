// Output of a pixel of the sea or the sky: a colour for the screen, or radiance for a display pass.
#include "film.glsl"

vec4 screen_colour(vec3 radiance) {
    if (output_kind.y > 0.5) return weighted_sample(radiance, output_kind.z);
    vec3 shown = filmic(night_vision(radiance, output_kind.w) * sun_irradiance.w);
    if (output_kind.x > 0.5) shown = srgb_encoded(shown) + dither(gl_FragCoord.xy) / 255.0;
    return vec4(shown, 1.0);
}
