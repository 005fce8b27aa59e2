// One triangle that covers the viewport, on the far plane.
#ifdef MULTIVIEW
#extension GL_OVR_multiview2 : require
layout(num_views = 2) in;
#endif
precision highp float;
#include "scene.glsl"

out vec3 ray;  // from the eye, any length

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    // A point on the ray, in homogeneous coordinates, because w may have any value.
    vec4 point = viewer_from_clip[EYE] * vec4(corner, 0.0, 1.0);
    ray = point.xyz - eye[EYE].xyz * point.w;
    gl_Position = vec4(corner, 1.0, 1.0);
}
