// Panel of the viewer: the font's coverage times the colour of the widget, which is already sRGB.
precision mediump float;
in vec2 at_font;
in vec4 tint;
uniform sampler2D font;
out vec4 result;

void main() { result = tint * texture(font, at_font); }
