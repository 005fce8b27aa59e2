// Cell of a light meter: the mean of the logarithms to base 2 of the luminance, and the logarithm
// of its mean. It takes 16 samples, each of four texels.
precision highp float;
#include "film.glsl"
#include "used_region.glsl"

uniform highp sampler2D radiance;
uniform vec4 radiance_used;
uniform vec4 cells;  // xy: number of cells; zw: 1 / xy

in vec2 place;
out vec4 colour;

void main() {
    vec2 corner = floor(place * cells.xy) * cells.zw;
    float sum = 0.0, sum_of_log2 = 0.0;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            vec2 at = corner + (vec2(x, y) + 0.5) * 0.25 * cells.zw;
            float luminance = max(luminance_of(unweighted(texture(radiance, in_used_region(at, radiance_used)))), 1e-12);
            sum += luminance;
            sum_of_log2 += log2(luminance);
        }
    colour = vec4(sum_of_log2 / 16.0, log2(sum / 16.0), 0.0, 1.0);
}
