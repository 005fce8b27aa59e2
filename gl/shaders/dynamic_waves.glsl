// Dynamic waves: a grid whose waves add to those of the cascades where water is drawn (sim/dynamic_waves_view.hpp). Its texture repeats, as the
// grid's own storage does, so texels stay where they are in the world while the grid moves.
uniform highp sampler2D dynamic_waves_texels;

// Height, slopes along x and z, and foam at a place relative to the viewer, where they are looked at so far apart; 0 outside the grid.
vec4 dynamic_waves(vec2 at, float apart_m) {
    vec2 from_middle = abs(at - dynamic_waves_extent.xy);
    if (max(from_middle.x, from_middle.y) >= dynamic_waves_extent.z) return vec4(0.0);
    return textureLod(dynamic_waves_texels, dynamic_waves_place.xy + at * dynamic_waves_place.z, max(log2(apart_m * dynamic_waves_place.w), 0.0));
}
