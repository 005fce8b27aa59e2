// Stub of URP's ShaderLibrary/Core.hlsl with what Ocean.shader uses: published signatures, no fog, one eye.
// https://docs.unity3d.com/Packages/com.unity.render-pipelines.universal@14.0/manual/use-built-in-shader-methods.html
#define UNITY_VERTEX_OUTPUT_STEREO
#define UNITY_SETUP_INSTANCE_ID(input)
#define UNITY_INITIALIZE_VERTEX_OUTPUT_STEREO(output)
#define UNITY_SETUP_STEREO_EYE_INDEX_POST_VERTEX(input)

float4 stub_clip_from_world[4];  // rows
float4 stub_camera;

float4 TransformWorldToHClip(float3 positionWS) {
    float4 at = float4(positionWS, 1.0);
    return float4(dot(stub_clip_from_world[0], at), dot(stub_clip_from_world[1], at), dot(stub_clip_from_world[2], at), dot(stub_clip_from_world[3], at));
}

float3 GetCameraPositionWS() { return stub_camera.xyz; }
float ComputeFogFactor(float z) { return 0.0; }
half3 MixFog(half3 fragColor, float fogFactor) { return fragColor; }
