// The layout is that of MeshLight in gl/meshes/lit_mesh.cpp. Directions are in the mesh's axes.
layout(std140) uniform MeshLight {
    highp mat4 clip_from_mesh;
    highp vec4 sun;             // xyz: direction towards the sun
    highp vec4 sun_irradiance;  // perpendicular to the rays; w: exposure that weights samples, or 0
    highp vec4 sky_irradiance;  // irradiance on a level plane
};
