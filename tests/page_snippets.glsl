// Names that GLSL code blocks of pages use without declaring them, for page_snippets_test.py.
#version 400 core
const int cascades = 2;
uniform vec2 rotation[cascades];
uniform float side[cascades], N, level;
uniform sampler2D displacement[cascades];
