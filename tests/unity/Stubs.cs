// Stubs of the types of Unity 2022.3 that unity/Runtime/Unity uses, with the published signatures.
// https://docs.unity3d.com/2022.3/Documentation/ScriptReference/ has a page for each: TYPE.html.
using System.Collections.Generic;
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
    public class MonoBehaviour : Object
    {
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Time-timeAsDouble.html</summary>
    public static class Time
    {
        public static double timeAsDouble { get; set; }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Vector3.html</summary>
    public struct Vector3
    {
        public float x, y, z;
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
            var bytes = new byte[data.Length * System.Runtime.InteropServices.Marshal.SizeOf(typeof(T))];
            System.Runtime.InteropServices.Marshal.Copy((System.IntPtr)data.Pointer, bytes, 0, bytes.Length);
            Levels[(mipLevel, element)] = bytes;
        }

        public void Apply(bool updateMipmaps = true, bool makeNoLongerReadable = false)
        {
            if (!updateMipmaps && !makeNoLongerReadable) ++Applied;
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

        public static void SetGlobalTexture(int nameID, Texture value) => Globals[names[nameID]] = value;
        public static void SetGlobalVectorArray(int nameID, Vector4[] values) => Globals[names[nameID]] = values;
    }
}

namespace Unity.Collections
{
    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Unity.Collections.Allocator.html</summary>
    public enum Allocator
    {
        Invalid,
        None,
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Unity.Collections.NativeArray_1.html</summary>
    public unsafe struct NativeArray<T> where T : struct
    {
        public void* Pointer;
        public int Length { get; set; }
    }
}

namespace Unity.Collections.LowLevel.Unsafe
{
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
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Unity.Collections.LowLevel.Unsafe.AtomicSafetyHandle.html</summary>
    public struct AtomicSafetyHandle
    {
        public static AtomicSafetyHandle GetTempMemoryHandle() => default;
    }
}
