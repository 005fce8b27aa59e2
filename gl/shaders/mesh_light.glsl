// Laid out as MeshLight of gl/meshes/lit_mesh.cpp. Directions in the mesh's own axes.
layout(std140) uniform MeshLight {
    highp mat4 clip_from_mesh;
    highp vec4 sun;             // xyz: towards it
    highp vec4 sun_irradiance;  // across the rays; w: exposure by which samples are weighted, or 0
    highp vec4 sky_irradiance;  // on a level plane
};
