// Dynamic waves (sim/dynamic_waves_view.hpp): a grid whose waves are added to the cascades at
// displaced positions. Its texture is periodic, like the grid's toroidal storage, so texels keep
// their world positions while the grid moves.
uniform highp sampler2D dynamic_waves_texels;

// Returns height, slopes along x and z, and foam at a position relative to the viewer, or 0 outside
// the grid. `apart_m` is the distance between samples.
vec4 dynamic_waves(vec2 at, float apart_m) {
    vec2 from_middle = abs(at - dynamic_waves_extent.xy);
    if (max(from_middle.x, from_middle.y) >= dynamic_waves_extent.z) return vec4(0.0);
    return textureLod(dynamic_waves_texels, dynamic_waves_place.xy + at * dynamic_waves_place.z, max(log2(apart_m * dynamic_waves_place.w), 0.0));
}
