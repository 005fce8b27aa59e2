// One triangle that covers the viewport.
precision highp float;

out vec2 place;  // [0, 1] over the viewport, from its lower left corner

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    place = corner;
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
