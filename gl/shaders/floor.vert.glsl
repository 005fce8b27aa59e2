// Floor mesh: strips of a level grid, displaced by the heights. The outermost vertices are far away
// and have the height of the edge.
#ifdef MULTIVIEW
#extension GL_OVR_multiview2 : require
layout(num_views = 2) in;
#endif
precision highp float;
precision highp int;
#include "scene.glsl"

uniform highp sampler2D floor_heights;

out vec4 place;  // relative to the viewer
out float sunlit_vertex;

#include "clouds.glsl"

invariant gl_Position;

void main() {
    ivec2 cells = ivec2(floor_mesh.xy);
    ivec2 index = ivec2(gl_VertexID / 2, gl_InstanceID + (gl_VertexID & 1));
    vec2 fraction = clamp((vec2(index) - 1.0) / vec2(cells), 0.0, 1.0);
    vec2 at = floor_size.zw + fraction * floor_size.xy;
    const float far_m = 3e4;
    if (index.x == 0) at.x = min(at.x, -far_m);
    if (index.y == 0) at.y = min(at.y, -far_m);
    if (index.x == cells.x + 2) at.x = max(at.x, far_m);
    if (index.y == cells.y + 2) at.y = max(at.y, far_m);
    float height = floor_look.x;
    if (floor_place.z > 0.0) height = textureLod(floor_heights, floor_place.xy + at * floor_place.zw, 0.0).x - viewer.w;
    sunlit_vertex = sunlit_at(at, 0.0);
    place = vec4(at.x, height - viewer.z, at.y, 1.0);
    gl_Position = clip_from_viewer[EYE] * place;
}
