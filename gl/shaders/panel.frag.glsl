// The viewer's panel: the font's coverage times the widget's colour, which is sRGB already.
precision mediump float;
in vec2 at_font;
in vec4 tint;
uniform sampler2D font;
out vec4 result;

void main() { result = tint * texture(font, at_font); }
