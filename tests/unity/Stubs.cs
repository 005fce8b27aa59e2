// Stubs of the types of Unity 2022.3 that unity/Runtime/Unity uses, with the published signatures.
// https://docs.unity3d.com/2022.3/Documentation/ScriptReference/ has a page for each: TYPE.html.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using Unity.Collections;

namespace UnityEngine
{
    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Object.html</summary>
    public class Object
    {
        public static readonly List<Object> Destroyed = new List<Object>();
        public static void Destroy(Object obj) => Destroyed.Add(obj);
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/MonoBehaviour.html</summary>
    public class MonoBehaviour : Behaviour
    {
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Component.html</summary>
    public class Component : Object
    {
        public readonly Transform Placed = new Transform();
        public readonly GameObject Owner = new GameObject();
        public Transform transform => Placed;
        public GameObject gameObject => Owner;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Behaviour.html</summary>
    public class Behaviour : Component
    {
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/GameObject.html</summary>
    public sealed class GameObject : Object
    {
        public int layer { get; set; }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Transform.html</summary>
    public class Transform : Object
    {
        public Vector3 position { get; set; }
        public Vector3 forward { get; set; }
        public Vector3 up { get; set; }
        public Quaternion rotation { get; set; }

        public void SetPositionAndRotation(Vector3 position, Quaternion rotation)
        {
            this.position = position;
            this.rotation = rotation;
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Camera.html</summary>
    public sealed class Camera : Behaviour
    {
        public Matrix4x4 cullingMatrix { get; set; }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Light.html</summary>
    public sealed class Light : Behaviour
    {
        public Color color { get; set; }
        public float intensity { get; set; }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/RenderSettings.html</summary>
    public sealed class RenderSettings : Object
    {
        public static Rendering.SphericalHarmonicsL2 ambientProbe { get; set; }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Time-timeAsDouble.html</summary>
    public static class Time
    {
        public static double timeAsDouble { get; set; }
        public static float fixedDeltaTime { get; set; } = 0.02f;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Vector3.html</summary>
    public struct Vector3
    {
        public float x, y, z;

        public Vector3(float x, float y, float z)
        {
            this.x = x;
            this.y = y;
            this.z = z;
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Quaternion.html</summary>
    public struct Quaternion
    {
        // Columns of the rotation's matrix.
        private Vector3 right, up, forward;

        public static Quaternion LookRotation(Vector3 forward, Vector3 upwards)
        {
            forward = Normalized(forward);
            var right = Normalized(Cross(upwards, forward));
            return new Quaternion { right = right, up = Cross(forward, right), forward = forward };
        }

        public static Vector3 operator *(Quaternion rotation, Vector3 point)
        {
            Vector3 x = rotation.right, y = rotation.up, z = rotation.forward;
            return new Vector3(x.x * point.x + y.x * point.y + z.x * point.z, x.y * point.x + y.y * point.y + z.y * point.z,
                               x.z * point.x + y.z * point.y + z.z * point.z);
        }

        private static Vector3 Cross(Vector3 a, Vector3 b)
        {
            return new Vector3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
        }

        private static Vector3 Normalized(Vector3 v)
        {
            var length = (float)Math.Sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
            return new Vector3(v.x / length, v.y / length, v.z / length);
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Color.html</summary>
    public struct Color
    {
        public float r, g, b, a;

        public Color(float r, float g, float b, float a)
        {
            this.r = r;
            this.g = g;
            this.b = b;
            this.a = a;
        }

        /// <summary>The stub's colours are linear.</summary>
        public Color linear => this;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Plane.html</summary>
    public struct Plane
    {
        public Vector3 normal { get; set; }
        public float distance { get; set; }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Matrix4x4.html</summary>
    public struct Matrix4x4
    {
        public Vector4 Row0, Row1, Row2, Row3;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Bounds.html</summary>
    public struct Bounds
    {
        public Vector3 center { get; set; }
        public Vector3 size { get; set; }

        public Bounds(Vector3 center, Vector3 size)
        {
            this.center = center;
            this.size = size;
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/GeometryUtility.html</summary>
    public sealed class GeometryUtility
    {
        public static void CalculateFrustumPlanes(Matrix4x4 worldToProjectionMatrix, Plane[] planes)
        {
            var m = worldToProjectionMatrix;
            planes[0] = PlaneOf(m.Row3, m.Row0, 1);
            planes[1] = PlaneOf(m.Row3, m.Row0, -1);
            planes[2] = PlaneOf(m.Row3, m.Row1, 1);
            planes[3] = PlaneOf(m.Row3, m.Row1, -1);
            planes[4] = PlaneOf(m.Row3, m.Row2, 1);
            planes[5] = PlaneOf(m.Row3, m.Row2, -1);
        }

        private static Plane PlaneOf(Vector4 w, Vector4 row, float sign)
        {
            float x = w.x + sign * row.x, y = w.y + sign * row.y, z = w.z + sign * row.z, d = w.w + sign * row.w;
            var length = (float)Math.Sqrt(x * x + y * y + z * z);
            return new Plane { normal = new Vector3(x / length, y / length, z / length), distance = d / length };
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Vector4.html</summary>
    public struct Vector4
    {
        public float x, y, z, w;

        public Vector4(float x, float y, float z, float w)
        {
            this.x = x;
            this.y = y;
            this.z = z;
            this.w = w;
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/TextureFormat.html</summary>
    public enum TextureFormat
    {
        RGBA32 = 4,
        RGBAHalf = 17,
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/TextureWrapMode.html</summary>
    public enum TextureWrapMode
    {
        Repeat,
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/FilterMode.html</summary>
    public enum FilterMode
    {
        Point,
        Bilinear,
        Trilinear,
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Texture.html</summary>
    public class Texture : Object
    {
        public TextureWrapMode wrapMode { get; set; }
        public FilterMode filterMode { get; set; }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Texture2DArray.html</summary>
    public sealed class Texture2DArray : Texture
    {
        public readonly int Side, Depth;
        public readonly bool HasMipmaps, IsLinear;
        public readonly TextureFormat Format;
        public readonly Dictionary<(int level, int slice), byte[]> Levels = new Dictionary<(int, int), byte[]>();
        public int Applied;

        public Texture2DArray(int width, int height, int depth, TextureFormat textureFormat, bool mipChain, bool linear)
        {
            Side = width;
            Depth = depth;
            Format = textureFormat;
            HasMipmaps = mipChain;
            IsLinear = linear;
        }

        public unsafe void SetPixelData<T>(NativeArray<T> data, int mipLevel, int element, int sourceDataStartIndex = 0) where T : struct
        {
            var bytes = new byte[data.Length * Marshal.SizeOf(typeof(T))];
            Marshal.Copy((IntPtr)data.Pointer, bytes, 0, bytes.Length);
            Levels[(mipLevel, element)] = bytes;
        }

        public void Apply(bool updateMipmaps = true, bool makeNoLongerReadable = false)
        {
            if (!updateMipmaps && !makeNoLongerReadable) ++Applied;
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Texture2D.html</summary>
    public sealed class Texture2D : Texture
    {
        public readonly int Side;
        public readonly bool HasMipmaps, IsLinear;
        public readonly Dictionary<int, Array> Levels = new Dictionary<int, Array>();
        public int Applied;

        public Texture2D(int width, int height, TextureFormat textureFormat, bool mipChain, bool linear)
        {
            Side = width;
            HasMipmaps = mipChain;
            IsLinear = linear;
        }

        public void SetPixelData<T>(T[] data, int mipLevel, int sourceDataStartIndex = 0) => Levels[mipLevel] = data;

        public void Apply(bool updateMipmaps = true, bool makeNoLongerReadable = false)
        {
            if (!updateMipmaps && !makeNoLongerReadable) ++Applied;
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/MeshTopology.html</summary>
    public enum MeshTopology
    {
        Triangles,
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Mesh.html</summary>
    public sealed class Mesh : Object
    {
        public readonly Dictionary<int, ushort[]> Submeshes = new Dictionary<int, ushort[]>();
        public Vector3[] vertices { get; set; }
        public int[] triangles { get; set; }
        public int subMeshCount { get; set; }

        public void SetIndices(ushort[] indices, MeshTopology topology, int submesh, bool calculateBounds = true, int baseVertex = 0) => Submeshes[submesh] = indices;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Material.html</summary>
    public class Material : Object
    {
        public readonly Dictionary<string, object> Values = new Dictionary<string, object>();
        public void SetVector(int nameID, Vector4 value) => Values[Shader.NameOf(nameID)] = value;
        public void SetVectorArray(int nameID, Vector4[] values) => Values[Shader.NameOf(nameID)] = values;
        public void SetTexture(int nameID, Texture value) => Values[Shader.NameOf(nameID)] = value;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/MaterialPropertyBlock.html</summary>
    public sealed class MaterialPropertyBlock
    {
        public readonly Dictionary<string, Vector4[]> Values = new Dictionary<string, Vector4[]>();

        public void SetVectorArray(int nameID, Vector4[] values)
        {
            Vector4[] copy;
            if (!Values.TryGetValue(Shader.NameOf(nameID), out copy)) Values[Shader.NameOf(nameID)] = copy = new Vector4[values.Length];
            values.CopyTo(copy, 0);
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/RenderParams.html</summary>
    public struct RenderParams
    {
        public readonly Material Drawn;
        public Camera camera { get; set; }
        public int layer { get; set; }
        public MaterialPropertyBlock matProps { get; set; }
        public Rendering.ShadowCastingMode shadowCastingMode { get; set; }
        public Bounds worldBounds { get; set; }

        public RenderParams(Material mat)
        {
            this = default(RenderParams);
            Drawn = mat;
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Graphics.html</summary>
    public class Graphics
    {
        public static readonly List<(RenderParams parameters, Mesh mesh, int submesh, int count)> Draws =
            new List<(RenderParams, Mesh, int, int)>();

        public static void RenderMeshPrimitives(in RenderParams rparams, Mesh mesh, int submeshIndex, int instanceCount = 1)
        {
            Draws.Add((rparams, mesh, submeshIndex, instanceCount));
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Shader.html</summary>
    public sealed class Shader : Object
    {
        private static readonly List<string> names = new List<string>();
        public static readonly Dictionary<string, object> Globals = new Dictionary<string, object>();

        public static int PropertyToID(string name)
        {
            names.Add(name);
            return names.Count - 1;
        }

        public static string NameOf(int nameID) => names[nameID];
        public static void SetGlobalTexture(int nameID, Texture value) => Globals[names[nameID]] = value;
        public static void SetGlobalVectorArray(int nameID, Vector4[] values) => Globals[names[nameID]] = values;
    }
}

namespace UnityEngine.Rendering
{
    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Rendering.ShadowCastingMode.html</summary>
    public enum ShadowCastingMode
    {
        Off,
        On,
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Rendering.SphericalHarmonicsL2.html</summary>
    public struct SphericalHarmonicsL2
    {
        /// <summary>The stub's light is equal from all directions.</summary>
        public Color Uniform;

        public void Evaluate(Vector3[] directions, Color[] results)
        {
            for (var i = 0; i < results.Length; ++i) results[i] = Uniform;
        }
    }
}

namespace Unity.Collections
{
    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Unity.Collections.Allocator.html</summary>
    public enum Allocator
    {
        Invalid,
        None,
        Temp,
        TempJob,
        Persistent,
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Unity.Collections.NativeArrayOptions.html</summary>
    public enum NativeArrayOptions
    {
        UninitializedMemory,
        ClearMemory,
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Unity.Collections.NativeArray_1.html</summary>
    public unsafe struct NativeArray<T> : IDisposable where T : struct
    {
        public void* Pointer;
        public int Length { get; set; }
        public bool IsCreated => Pointer != null;

        public NativeArray(int length, Allocator allocator, NativeArrayOptions options = NativeArrayOptions.ClearMemory)
        {
            Pointer = (void*)Marshal.AllocHGlobal(length * Marshal.SizeOf(typeof(T)));
            Length = length;
            if (options == NativeArrayOptions.ClearMemory) new Span<byte>(Pointer, length * Marshal.SizeOf(typeof(T))).Clear();
        }

        public T this[int index]
        {
            get => new Span<T>(Pointer, Length)[index];
            set => new Span<T>(Pointer, Length)[index] = value;
        }

        public void Dispose()
        {
            Marshal.FreeHGlobal((IntPtr)Pointer);
            Pointer = null;
        }
    }
}

namespace Unity.Collections.LowLevel.Unsafe
{
    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Unity.Collections.LowLevel.Unsafe.NativeDisableUnsafePtrRestrictionAttribute.html</summary>
    [AttributeUsage(AttributeTargets.Field)]
    public sealed class NativeDisableUnsafePtrRestrictionAttribute : Attribute
    {
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Unity.Collections.LowLevel.Unsafe.NativeArrayUnsafeUtility.html</summary>
    public static class NativeArrayUnsafeUtility
    {
        public static unsafe NativeArray<T> ConvertExistingDataToNativeArray<T>(void* dataPointer, int length, Allocator allocator) where T : struct
        {
            return new NativeArray<T> { Pointer = dataPointer, Length = length };
        }

        public static void SetAtomicSafetyHandle<T>(ref NativeArray<T> array, AtomicSafetyHandle safety) where T : struct
        {
        }

        public static unsafe void* GetUnsafePtr<T>(this NativeArray<T> nativeArray) where T : struct => nativeArray.Pointer;
        public static unsafe void* GetUnsafeReadOnlyPtr<T>(this NativeArray<T> nativeArray) where T : struct => nativeArray.Pointer;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Unity.Collections.LowLevel.Unsafe.AtomicSafetyHandle.html</summary>
    public struct AtomicSafetyHandle
    {
        public static AtomicSafetyHandle GetTempMemoryHandle() => default;
    }
}

namespace Unity.Jobs
{
    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Unity.Jobs.IJobParallelFor.html</summary>
    public interface IJobParallelFor
    {
        void Execute(int index);
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Unity.Jobs.JobHandle.html</summary>
    public struct JobHandle
    {
        public System.Threading.Tasks.Task Work;
        public void Complete() => Work?.Wait();
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Unity.Jobs.IJobParallelForExtensions.html</summary>
    public static class IJobParallelForExtensions
    {
        /// <summary>False: Schedule() does the work, so that its allocations are the caller's.</summary>
        public static bool HasThreads = true;

        public static JobHandle Schedule<T>(this T jobData, int arrayLength, int innerloopBatchCount, JobHandle dependsOn = default) where T : struct, IJobParallelFor
        {
            if (!HasThreads)
            {
                dependsOn.Complete();
                for (var i = arrayLength - 1; i >= 0; --i) jobData.Execute(i);
                return default;
            }
            return OnThreads(jobData, arrayLength, dependsOn);
        }

        private static JobHandle OnThreads<T>(T jobData, int arrayLength, JobHandle dependsOn) where T : struct, IJobParallelFor
        {
            return new JobHandle
            {
                Work = System.Threading.Tasks.Task.Run(() =>
                {
                    dependsOn.Complete();
                    System.Threading.Tasks.Parallel.For(0, arrayLength, jobData.Execute);
                }),
            };
        }
    }
}
