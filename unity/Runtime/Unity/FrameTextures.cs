using System;
using System.Runtime.InteropServices;
using Unity.Collections;
using Unity.Collections.LowLevel.Unsafe;
using UnityEngine;

namespace Pelagic.Unity
{
    /// <summary>
    /// Textures of a frame, with a slice for each cascade. The ocean writes texels into their memory, and Apply() sends
    /// that to the GPU. Two of them take turns: one is drawn while the ocean writes into the other.
    /// </summary>
    internal sealed unsafe class FrameTextures
    {
        // Of pelagic_texture_targets. Unity documents no alignment, so a texture may lie elsewhere and is then copied.
        private const long DisplacementAlignment = 64;

        internal readonly Texture2DArray Displacement, Slopes, Moments;
        private readonly TextureTargets[] targets;
        private readonly int levels;

        internal FrameTextures(int resolution, int cascades)
        {
            Displacement = ArrayOf(resolution, cascades, TextureFormat.RGBAHalf, false);
            Slopes = ArrayOf(resolution, cascades, TextureFormat.RGBA32, true);
            Moments = ArrayOf(resolution, cascades, TextureFormat.RGBA32, true);
            levels = Slopes.mipmapCount;
            targets = new TextureTargets[cascades];
            for (var i = 0; i < cascades; ++i) targets[i] = new TextureTargets { SlopesRgba8 = new IntPtr[levels], MomentsRgba8 = new IntPtr[levels] };
        }

        /// <summary>The memory of the textures, until the next Apply().</summary>
        internal TextureTargets[] Targets()
        {
            for (var i = 0; i < targets.Length; ++i)
            {
                var displacement = (IntPtr)Displacement.GetPixelData<ulong>(0, i).GetUnsafePtr();
                targets[i].DisplacementRgba16f = displacement.ToInt64() % DisplacementAlignment == 0 ? displacement : IntPtr.Zero;
                for (var level = 0; level < levels; ++level)
                {
                    targets[i].SlopesRgba8[level] = (IntPtr)Slopes.GetPixelData<uint>(level, i).GetUnsafePtr();
                    targets[i].MomentsRgba8[level] = (IntPtr)Moments.GetPixelData<uint>(level, i).GetUnsafePtr();
                }
            }
            return targets;
        }

        /// <summary>Sends the textures of a frame that was scheduled into Targets() to the GPU.</summary>
        internal void Apply(in Frame frame)
        {
            for (var i = 0; i < targets.Length; ++i)
            {
                if (targets[i].DisplacementRgba16f != IntPtr.Zero) continue;
                var texels = frame.Cascade(i).DisplacementRgba16f;
                fixed (ushort* first = &MemoryMarshal.GetReference(texels)) Copy<ushort>(first, texels.Length, Displacement, 0, i);
            }
            Displacement.Apply(false);
            Slopes.Apply(false);
            Moments.Apply(false);
        }

        internal void Destroy()
        {
            UnityEngine.Object.Destroy(Displacement);
            UnityEngine.Object.Destroy(Slopes);
            UnityEngine.Object.Destroy(Moments);
        }

        internal static Texture2DArray ArrayOf(int side, int depth, TextureFormat format, bool hasMipmaps)
        {
            // Linear: the values are no colours.
            return new Texture2DArray(side, side, depth, format, hasMipmaps, true)
            {
                wrapMode = TextureWrapMode.Repeat,
                filterMode = hasMipmaps ? FilterMode.Trilinear : FilterMode.Bilinear,
            };
        }

        /// <summary>Copies the levels of a chain of a frame.</summary>
        internal static void Copy(in Cascade cascade, ReadOnlySpan<uint> chain, Texture2DArray texture, int slice)
        {
            fixed (uint* texels = &MemoryMarshal.GetReference(chain))
                for (var level = 0; level < cascade.Levels; ++level)
                {
                    var side = cascade.Resolution >> level;
                    Copy<uint>(texels + cascade.LevelOffset(level), side * side, texture, level, slice);
                }
        }

        /// <summary>Copies texels from the library's memory, without an array in between.</summary>
        private static void Copy<T>(void* texels, int count, Texture2DArray texture, int level, int slice) where T : struct
        {
            var data = NativeArrayUnsafeUtility.ConvertExistingDataToNativeArray<T>(texels, count, Allocator.None);
#if ENABLE_UNITY_COLLECTIONS_CHECKS
            NativeArrayUnsafeUtility.SetAtomicSafetyHandle(ref data, AtomicSafetyHandle.GetTempMemoryHandle());
#endif
            texture.SetPixelData(data, level, slice);
        }
    }
}
