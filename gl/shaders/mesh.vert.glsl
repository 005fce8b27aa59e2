// Application mesh, lit by sun and sky.
precision highp float;
#include "mesh_light.glsl"

layout(location = 0) in vec3 position;  // metres, y above the still-water level
layout(location = 1) in vec3 outwards;
layout(location = 2) in vec3 painted;
out vec3 at;
out vec3 facing;
out vec3 paint;

void main() {
    at = position;
    facing = outwards;
    paint = painted;
    gl_Position = clip_from_mesh * vec4(position, 1.0);
}
