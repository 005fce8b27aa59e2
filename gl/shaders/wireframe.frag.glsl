// Wireframe of the mesh with a colour per level, so that borders between levels are visible.
precision highp float;
precision highp int;

uniform float brightness;
flat in int patch_level;
in vec4 place;
out vec4 colour;

void main() {
    // Hues are a golden angle apart, so that neighbouring levels differ strongly.
    float hue = fract(float(patch_level) * 0.381966);
    vec3 rgb = clamp(abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    colour = vec4(mix(vec3(0.75), rgb, 0.75) * brightness, 1.0);
}
