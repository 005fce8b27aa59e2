// Adds the sum of all coarser levels of the bloom to a level; all levels have equal weights. Bjorge
// 2015, "Bandwidth-Efficient Rendering" (upsampling of the dual filter). The filter weights add up
// to 1.
precision highp float;
#include "used_region.glsl"

uniform highp sampler2D level;    // as large as the output
uniform highp sampler2D coarser;  // half as large; includes all coarser levels
uniform vec4 level_used;
uniform vec4 coarser_used;
uniform float coarser_weight;

in vec2 place;
out vec4 colour;

vec3 at(vec2 texels) {
    return texture(coarser, in_used_region(place + texels * coarser_used.zw / coarser_used.xy, coarser_used)).rgb;
}

void main() {
    vec3 spread = (at(vec2(-1.0, 0.0)) + at(vec2(1.0, 0.0)) + at(vec2(0.0, -1.0)) + at(vec2(0.0, 1.0))) / 12.0 +
                  (at(vec2(-0.5, -0.5)) + at(vec2(0.5, -0.5)) + at(vec2(-0.5, 0.5)) + at(vec2(0.5, 0.5))) / 6.0;
    colour = vec4(mix(texture(level, in_used_region(place, level_used)).rgb, spread, coarser_weight), 1.0);
}
