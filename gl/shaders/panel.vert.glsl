// Panel of the viewer: triangles of Dear ImGui, in pixels from the window's upper left corner.
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 font_position;
layout(location = 2) in vec4 colour;
uniform vec2 window_size;
out vec2 at_font;
out vec4 tint;

void main() {
    at_font = font_position;
    tint = colour;
    gl_Position = vec4(2.0 * position.x / window_size.x - 1.0, 1.0 - 2.0 * position.y / window_size.y, 0.0, 1.0);
}
