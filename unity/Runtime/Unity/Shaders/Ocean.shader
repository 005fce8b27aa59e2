// Surface of the sea for URP. OceanSurface.cs draws patches of a quadtree with it.
Shader "Pelagic/Ocean"
{
    SubShader
    {
        PackageRequirements { "com.unity.render-pipelines.universal" : "14.0" }
        Tags { "RenderPipeline" = "UniversalPipeline" "RenderType" = "Opaque" "Queue" = "Geometry" }

        Pass
        {
            Name "Forward"
            Tags { "LightMode" = "UniversalForward" }
            // Folded crests show their undersides.
            Cull Off

            HLSLPROGRAM
            #pragma target 3.5
            #pragma vertex Vertex
            #pragma fragment Fragment
            #pragma multi_compile_fog
            #pragma multi_compile_instancing
            #include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Core.hlsl"
            #include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Lighting.hlsl"

            float3 PelagicSky(float3 direction, float roughness)
            {
                return GlossyEnvironmentReflection(half3(direction.x, direction.y, -direction.z), half(roughness), half(1.0));
            }

            #include "Packages/com.pelagic.ocean/Runtime/Unity/Shaders/Pelagic.hlsl"

            struct Attributes
            {
                float3 ij : POSITION;
                uint instanceID : SV_InstanceID;
            };

            struct Varyings
            {
                float4 positionCS : SV_POSITION;
                float4 place : TEXCOORD0;  // w: fog
                float2 rest : TEXCOORD1;
                float4 coarsest : TEXCOORD2;
                UNITY_VERTEX_OUTPUT_STEREO
            };

            Varyings Vertex(Attributes input)
            {
                Varyings output = (Varyings)0;
                UNITY_SETUP_INSTANCE_ID(input);
                UNITY_INITIALIZE_VERTEX_OUTPUT_STEREO(output);
                uint instance = input.instanceID;
            #if defined(UNITY_STEREO_INSTANCING_ENABLED)
                instance >>= 1;  // each patch has an instance for each eye
            #endif
                PelagicVertex vertex = PelagicVertexOf(instance, int2(input.ij.xz));
                float3 position = _PelagicViewer.xyz + float3(vertex.place.x, vertex.place.y, -vertex.place.z);
                output.positionCS = TransformWorldToHClip(position);
                output.place = float4(vertex.place, ComputeFogFactor(output.positionCS.z));
                output.rest = vertex.rest;
                output.coarsest = vertex.coarsest;
                return output;
            }

            half4 Fragment(Varyings input) : SV_Target
            {
                UNITY_SETUP_STEREO_EYE_INDEX_POST_VERTEX(input);
                float3 eye = GetCameraPositionWS() - _PelagicViewer.xyz;
                PelagicVertex vertex;
                vertex.place = input.place.xyz;
                vertex.rest = input.rest;
                vertex.coarsest = input.coarsest;
                float3 radiance = PelagicRadiance(vertex, float3(eye.x, eye.y, -eye.z));
                return half4(MixFog(half3(radiance), input.place.w), 1.0);
            }
            ENDHLSL
        }
    }
}
