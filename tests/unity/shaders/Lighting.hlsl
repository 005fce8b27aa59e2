// Stub of URP's ShaderLibrary/Lighting.hlsl. The sky is a cube in the sea's axes, whose level m is blurred as by a
// mirror with roughness m / last, as in gl/shaders/mirror.glsl.
TextureCube stub_sky;
SamplerState sampler_stub_sky;
float4 stub_sky_levels;  // x: last level

half3 GlossyEnvironmentReflection(half3 reflectVector, half perceptualRoughness, half occlusion) {
    float3 direction = float3(reflectVector.x, reflectVector.y, -reflectVector.z);
    return half3(stub_sky.SampleLevel(sampler_stub_sky, direction, perceptualRoughness * stub_sky_levels.x).rgb * occlusion);
}
