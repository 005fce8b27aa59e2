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

        public Vector3(float x, float y, float z)
        {
            this.x = x;
            this.y = y;
            this.z = z;
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
