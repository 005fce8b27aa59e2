// Display pass: bloom, exposure, night vision, the tone curve, sRGB and dithering.
precision highp float;
#include "film.glsl"
#include "used_region.glsl"

uniform highp sampler2D radiance;
uniform highp sampler2D spread;
uniform vec4 radiance_used;
uniform vec4 spread_used;
// x: exposure; y: luminance of a radiance of 1, cd/m^2; z: fraction of the light that bloom
// spreads; w: 1 if the shader encodes sRGB
uniform vec4 look;

in vec2 place;
out vec4 colour;

void main() {
    vec3 light = unweighted(texture(radiance, in_used_region(place, radiance_used)));
    if (look.z > 0.0) light = mix(light, texture(spread, in_used_region(place, spread_used)).rgb, look.z);
    vec3 shown = filmic(night_vision(light, look.y) * look.x);
    if (look.w > 0.5) shown = srgb_encoded(shown) + dither(gl_FragCoord.xy) / 255.0;
    colour = vec4(shown, 1.0);
}
