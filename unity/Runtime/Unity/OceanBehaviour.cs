using System.Runtime.InteropServices;
using Unity.Collections;
using Unity.Collections.LowLevel.Unsafe;
using UnityEngine;

namespace Pelagic.Unity
{
    /// <summary>
    /// An ocean in a scene. Each Update() completes the frame that the previous one scheduled, uploads its textures
    /// and schedules the next, which is computed while the scene is drawn. Unity's z axis is -z of the sea.
    ///
    /// Shaders find the textures as _PelagicDisplacement, _PelagicSlopes and _PelagicMoments, arrays with one slice
    /// for each cascade, and _PelagicCascades: side in metres, cosine, sine and slope range.
    /// </summary>
    public sealed unsafe class OceanBehaviour : MonoBehaviour
    {
        private const int MaxCascades = 4;
        private static readonly int displacementId = Shader.PropertyToID("_PelagicDisplacement"), slopesId = Shader.PropertyToID("_PelagicSlopes"),
                                    momentsId = Shader.PropertyToID("_PelagicMoments"), cascadesId = Shader.PropertyToID("_PelagicCascades");

        /// <summary>Name of a preset; see Sea.Preset().</summary>
        public string Preset = "moderate";
        /// <summary>Texels along a side of a cascade. 0: that of the preset.</summary>
        public int Resolution;

        // An array of this length, because Unity fixes the length of a shader's array at the first call.
        private readonly Vector4[] cascades = new Vector4[MaxCascades];

        /// <summary>Null while the component is disabled.</summary>
        public Ocean Ocean { get; private set; }
        /// <summary>The frame that is drawn.</summary>
        public Frame Frame { get; private set; }
        public Texture2DArray Displacement { get; private set; }
        public Texture2DArray Slopes { get; private set; }
        public Texture2DArray Moments { get; private set; }

        /// <summary>Height of the water at a position of the scene.</summary>
        public float HeightAt(Vector3 position)
        {
            return Ocean.HeightAt(position.x, -position.z);
        }

        private void OnEnable()
        {
            var sea = Sea.Preset(Preset);
            if (Resolution != 0) sea.Resolution = Resolution;
            Ocean = new Ocean(sea, new OceanOptions { Queries = true, Slopes = true });
            var info = Ocean.Info;
            Displacement = ArrayOf(info, TextureFormat.RGBAHalf, false);
            Slopes = ArrayOf(info, TextureFormat.RGBA32, true);
            Moments = ArrayOf(info, TextureFormat.RGBA32, true);
            Ocean.Schedule(Time.timeAsDouble);
        }

        private void Update()
        {
            Frame = Ocean.Complete();
            Ocean.Schedule(Time.timeAsDouble);
            for (var i = 0; i < Frame.CascadeCount; ++i)
            {
                var cascade = Frame.Cascade(i);
                var displacement = cascade.DisplacementRgba16f;
                fixed (ushort* texels = &MemoryMarshal.GetReference(displacement)) Upload<ushort>(texels, displacement.Length, Displacement, 0, i);
                fixed (uint* slopes = &MemoryMarshal.GetReference(cascade.SlopesRgba8), moments = &MemoryMarshal.GetReference(cascade.MomentsRgba8))
                    for (var level = 0; level < cascade.Levels; ++level)
                    {
                        int side = cascade.Resolution >> level, offset = cascade.LevelOffset(level);
                        Upload<uint>(slopes + offset, side * side, Slopes, level, i);
                        Upload<uint>(moments + offset, side * side, Moments, level, i);
                    }
                cascades[i] = new Vector4((float)cascade.SideM, (float)cascade.Cosine, (float)cascade.Sine, cascade.SlopeRange);
            }
            Displacement.Apply(false);
            Slopes.Apply(false);
            Moments.Apply(false);
            Shader.SetGlobalTexture(displacementId, Displacement);
            Shader.SetGlobalTexture(slopesId, Slopes);
            Shader.SetGlobalTexture(momentsId, Moments);
            Shader.SetGlobalVectorArray(cascadesId, cascades);
        }

        private void OnDisable()
        {
            Ocean?.Dispose();
            Ocean = null;
            Destroy(Displacement);
            Destroy(Slopes);
            Destroy(Moments);
        }

        private static Texture2DArray ArrayOf(OceanInfo info, TextureFormat format, bool hasMipmaps)
        {
            // Linear: the values are no colours.
            return new Texture2DArray(info.Resolution, info.Resolution, info.CascadeCount, format, hasMipmaps, true)
            {
                wrapMode = TextureWrapMode.Repeat,
                filterMode = hasMipmaps ? FilterMode.Trilinear : FilterMode.Bilinear,
            };
        }

        /// <summary>Copies texels from the library's memory, without an array in between.</summary>
        private static void Upload<T>(void* texels, int count, Texture2DArray texture, int level, int slice) where T : struct
        {
            var data = NativeArrayUnsafeUtility.ConvertExistingDataToNativeArray<T>(texels, count, Allocator.None);
#if ENABLE_UNITY_COLLECTIONS_CHECKS
            NativeArrayUnsafeUtility.SetAtomicSafetyHandle(ref data, AtomicSafetyHandle.GetTempMemoryHandle());
#endif
            texture.SetPixelData(data, level, slice);
        }
    }
}
