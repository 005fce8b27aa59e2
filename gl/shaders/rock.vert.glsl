// A rock in the light of sun and sky.
precision highp float;
#include "rock_light.glsl"

layout(location = 0) in vec3 position;  // metres from the middle of its foot at rest
layout(location = 1) in vec3 outwards;
out vec3 at;
out vec3 facing;

void main() {
    at = position;
    facing = outwards;
    gl_Position = clip_from_rock * vec4(position, 1.0);
}
