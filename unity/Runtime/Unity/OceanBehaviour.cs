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
    /// for each cascade, and _PelagicCascades: side in metres, cosine, sine and slope range. With Foam, slice 3 i + j
    /// of _PelagicSnapshots is image i of 2 of the snapshots of cascade j of 3.
    /// </summary>
    public sealed unsafe class OceanBehaviour : MonoBehaviour
    {
        private const int MaxCascades = 4, FoamCascades = 3, SnapshotImages = 2;
        private static readonly int displacementId = Shader.PropertyToID("_PelagicDisplacement"), slopesId = Shader.PropertyToID("_PelagicSlopes"),
                                    momentsId = Shader.PropertyToID("_PelagicMoments"),
                                    snapshotsId = Shader.PropertyToID("_PelagicSnapshots"), cascadesId = Shader.PropertyToID("_PelagicCascades");

        /// <summary>Name of a preset; see Sea.Preset().</summary>
        public string Preset = "moderate";
        /// <summary>Texels along a side of a cascade. 0: that of the preset.</summary>
        public int Resolution;
        /// <summary>Computes foam.</summary>
        public bool Foam = true;
        /// <summary>Computes velocities of the surface for queries.</summary>
        public bool Velocities;
        /// <summary>Computes pressure and velocity below the surface, which OceanFloating needs.</summary>
        public bool Depth;
        /// <summary>Computes dynamic waves with DynamicWavesOptions.Default; see Ocean.DynamicWaves.</summary>
        public bool DynamicWaves;

        // An array of this length, because Unity fixes the length of a shader's array at the first call.
        private readonly Vector4[] cascades = new Vector4[MaxCascades];
        private (double X, double Z)? origin;  // of the next frames
        private readonly ulong[] versions = new ulong[FoamCascades * SnapshotImages];

        /// <summary>Null while the component is disabled.</summary>
        public Ocean Ocean { get; private set; }
        /// <summary>The frame that is drawn, if HasFrame.</summary>
        public Frame Frame { get; private set; }
        public bool HasFrame { get; private set; }
        public Texture2DArray Displacement { get; private set; }
        public Texture2DArray Slopes { get; private set; }
        public Texture2DArray Moments { get; private set; }
        /// <summary>Null without Foam.</summary>
        public Texture2DArray Snapshots { get; private set; }
        /// <summary>The sea of the preset.</summary>
        public Sea Sea { get; private set; }

        /// <summary>Between frames of Ocean, after Complete() and before Schedule().</summary>
        public event System.Action BetweenFrames;

        /// <summary>
        /// Shifts the origin to a position of the sea, as Ocean.SetOrigin(), in the next Update(), after BetweenFrames. Move
        /// the scene and the camera when Frame.OriginXM or OriginZM changes. OceanFloating moves by itself.
        /// </summary>
        public void SetOrigin(double xM, double zM)
        {
            origin = (xM, zM);
        }

        /// <summary>Height of the water at a position of the scene.</summary>
        public float HeightAt(Vector3 position)
        {
            return Ocean.HeightAt(position.x, -position.z);
        }

        private void OnEnable()
        {
            var sea = Sea.Preset(Preset);
            if (Resolution != 0) sea.Resolution = Resolution;
            Sea = sea;
            var options = new OceanOptions { Queries = true, Velocities = Velocities ? Pelagic.Velocities.Drawn : Pelagic.Velocities.None, Depth = Depth, Slopes = Textures.On, Foam = Foam };
            if (DynamicWaves) options.DynamicWaves = DynamicWavesOptions.Default;
            Ocean = new Ocean(sea, options);
            SetOrigin();
            var info = Ocean.Info;
            Displacement = ArrayOf(info.Resolution, info.CascadeCount, TextureFormat.RGBAHalf, false);
            Slopes = ArrayOf(info.Resolution, info.CascadeCount, TextureFormat.RGBA32, true);
            Moments = ArrayOf(info.Resolution, info.CascadeCount, TextureFormat.RGBA32, true);
            if (Foam) Snapshots = ArrayOf(info.Resolution, versions.Length, TextureFormat.RGBA32, true);
            System.Array.Clear(versions, 0, versions.Length);
            Ocean.Schedule(Time.timeAsDouble);
        }

        private void SetOrigin()
        {
            if (origin != null) Ocean.SetOrigin(origin.Value.X, origin.Value.Z);
        }

        private void Update()
        {
            Frame = Ocean.Complete();
            HasFrame = true;
            BetweenFrames?.Invoke();
            SetOrigin();
            Ocean.Schedule(Time.timeAsDouble);
            for (var i = 0; i < Frame.CascadeCount; ++i)
            {
                var cascade = Frame.Cascade(i);
                var displacement = cascade.DisplacementRgba16f;
                fixed (ushort* texels = &MemoryMarshal.GetReference(displacement)) Upload<ushort>(texels, displacement.Length, Displacement, 0, i);
                Upload(cascade, cascade.SlopesRgba8, Slopes, i);
                Upload(cascade, cascade.MomentsRgba8, Moments, i);
                cascades[i] = new Vector4((float)cascade.SideM, (float)cascade.Cosine, (float)cascade.Sine, cascade.SlopeRange);
            }
            Displacement.Apply(false);
            Slopes.Apply(false);
            Moments.Apply(false);
            Shader.SetGlobalTexture(displacementId, Displacement);
            Shader.SetGlobalTexture(slopesId, Slopes);
            Shader.SetGlobalTexture(momentsId, Moments);
            Shader.SetGlobalVectorArray(cascadesId, cascades);
            if (Snapshots != null) UploadSnapshots();
        }

        /// <summary>Uploads images that have changed, which they do about five times a second.</summary>
        private void UploadSnapshots()
        {
            var hasChanged = false;
            for (var i = 0; i < versions.Length; ++i)
            {
                int image = i / FoamCascades, index = i % FoamCascades;
                if (index >= Frame.CascadeCount) continue;
                var cascade = Frame.Cascade(index);
                var snapshots = cascade.SnapshotsRgba8(image);
                if (snapshots.IsEmpty || cascade.SnapshotsVersion(image) == versions[i]) continue;
                versions[i] = cascade.SnapshotsVersion(image);
                Upload(cascade, snapshots, Snapshots, i);
                hasChanged = true;
            }
            if (hasChanged) Snapshots.Apply(false);
            Shader.SetGlobalTexture(snapshotsId, Snapshots);
        }

        private void OnDisable()
        {
            HasFrame = false;
            Ocean?.Dispose();
            Ocean = null;
            Destroy(Displacement);
            Destroy(Slopes);
            Destroy(Moments);
            if (Snapshots != null) Destroy(Snapshots);
            Snapshots = null;
        }

        private static Texture2DArray ArrayOf(int side, int depth, TextureFormat format, bool hasMipmaps)
        {
            // Linear: the values are no colours.
            return new Texture2DArray(side, side, depth, format, hasMipmaps, true)
            {
                wrapMode = TextureWrapMode.Repeat,
                filterMode = hasMipmaps ? FilterMode.Trilinear : FilterMode.Bilinear,
            };
        }

        private static void Upload(in Cascade cascade, System.ReadOnlySpan<uint> chain, Texture2DArray texture, int slice)
        {
            fixed (uint* texels = &MemoryMarshal.GetReference(chain))
                for (var level = 0; level < cascade.Levels; ++level)
                {
                    var side = cascade.Resolution >> level;
                    Upload<uint>(texels + cascade.LevelOffset(level), side * side, texture, level, slice);
                }
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
