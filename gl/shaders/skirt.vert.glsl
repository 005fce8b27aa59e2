// Flat sea from the border of the grid to the horizon. The outer vertices of quadtree/skirt.hpp lie
// 10 S away, which is nearer than the horizon for a high viewer. Here they lie in the same
// direction at infinity.
#ifdef MULTIVIEW
#extension GL_OVR_multiview2 : require
layout(num_views = 2) in;
#endif
precision highp float;
precision highp int;
#include "scene.glsl"

layout(location = 1) in uint start;  // steps along the side
layout(location = 2) in uvec2 level_and_side;

out vec4 place;
flat out int patch_level;

invariant gl_Position;

void main() {
    int last = int(grid.w);
    int t = gl_VertexID / 2;
    int side = int(level_and_side.y);  // +x, +z, -x, -z
    int stride = 1 << (int(skirt.w) - int(level_and_side.x));
    bool runs_down = side == 1 || side == 2;
    int along = int(start) + (runs_down ? last - t : t) * stride;
    int across = side < 2 ? int(skirt.z) : 0;
    ivec2 index = side == 0 || side == 2 ? ivec2(across, along) : ivec2(along, across);
    vec2 at = grid.xy + vec2(index) * grid.z;
    patch_level = int(level_and_side.x);
    if ((gl_VertexID & 1) == 0) {
        place = vec4(at.x, -viewer.z, at.y, 1.0);
        gl_Position = clip_from_viewer[EYE] * place;
    } else {
        vec2 outwards = (at - skirt.xy) / (skirt.z * grid.z);
        place = vec4(outwards.x, 0.0, outwards.y, 0.0);
        gl_Position = clip_from_viewer[EYE] * place;
        // On the far plane, and not behind it after rounding.
        gl_Position.z = min(gl_Position.z, gl_Position.w * 0.9999995);
    }
}
