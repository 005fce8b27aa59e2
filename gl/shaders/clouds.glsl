// Shadows of the clouds. They are soft: vertices of the patches sample them, and pixels beyond.
uniform mediump sampler2D cloud_shadows;

// Returns the fraction of sun_irradiance that the clouds let through, in a square of a width.
float sunlit_at(vec2 at, float wide_m) {
    // At the horizon the width is infinite.
    float texels = clamp(wide_m * cloud_place.z * float(textureSize(cloud_shadows, 0).x), 1.0, 256.0);
    float mip = log2(texels);
    return 1.0 - cloud_place.w * (1.0 - textureLod(cloud_shadows, cloud_place.xy + at * cloud_place.z, mip).r);
}
