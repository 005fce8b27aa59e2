// Halves the size of an image: Bjorge 2015, "Bandwidth-Efficient Rendering" (dual filtering). The
// weights add up to 1.
precision highp float;
#include "used_region.glsl"

uniform highp sampler2D finer;
uniform vec4 finer_used;

in vec2 place;
out vec4 colour;

vec3 at(vec2 texels) { return unweighted(texture(finer, in_used_region(place + texels * finer_used.zw / finer_used.xy, finer_used))); }

void main() {
    colour = vec4(0.5 * at(vec2(0.0)) + 0.125 * (at(vec2(-1.0, -1.0)) + at(vec2(1.0, -1.0)) + at(vec2(-1.0, 1.0)) +
                                                 at(vec2(1.0, 1.0))), 1.0);
}
