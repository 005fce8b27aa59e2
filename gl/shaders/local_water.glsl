// Water that answers: a window whose waves add to those of the tiles where water is drawn (sim/local_surface.hpp). Its texture repeats, as the
// window's own storage does, so texels stay where they are in the world while the window moves.
uniform highp sampler2D local_texels;

// Height, slopes along x and z, and foam at a place relative to the viewer, where they are looked at so far apart; 0 outside the window.
vec4 local_water(vec2 at, float apart_m) {
    vec2 from_middle = abs(at - local_window.xy);
    if (max(from_middle.x, from_middle.y) >= local_window.z) return vec4(0.0);
    return textureLod(local_texels, local_place.xy + at * local_place.z, max(log2(apart_m * local_place.w), 0.0));
}
