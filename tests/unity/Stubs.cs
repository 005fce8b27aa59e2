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
        public static void Destroy(Object obj)
        {
            obj.End();
            Destroyed.Add(obj);
        }

        public string name { get; set; } = "Thing";

        /// <summary>Of the stub: frees what Unity's objects hold.</summary>
        protected virtual void End()
        {
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/RangeAttribute.html</summary>
    [AttributeUsage(AttributeTargets.Field)]
    public sealed class RangeAttribute : Attribute
    {
        public readonly float min, max;

        public RangeAttribute(float min, float max)
        {
            this.min = min;
            this.max = max;
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/MinAttribute.html</summary>
    [AttributeUsage(AttributeTargets.Field)]
    public sealed class MinAttribute : Attribute
    {
        public readonly float min;
        public MinAttribute(float min) => this.min = min;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/TooltipAttribute.html</summary>
    [AttributeUsage(AttributeTargets.Field)]
    public sealed class TooltipAttribute : Attribute
    {
        public readonly string tooltip;
        public TooltipAttribute(string tooltip) => this.tooltip = tooltip;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/HeaderAttribute.html</summary>
    [AttributeUsage(AttributeTargets.Field)]
    public sealed class HeaderAttribute : Attribute
    {
        public readonly string header;
        public HeaderAttribute(string header) => this.header = header;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/DefaultExecutionOrder.html</summary>
    [AttributeUsage(AttributeTargets.Class)]
    public class DefaultExecutionOrder : Attribute
    {
        public int order { get; }
        public DefaultExecutionOrder(int order) => this.order = order;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Debug.LogError.html</summary>
    public class Debug
    {
        public static readonly List<string> Errors = new List<string>();
        public static void LogError(object message, Object context) => Errors.Add((string)message);
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Application-isPlaying.html</summary>
    public class Application
    {
        public static bool isPlaying { get; set; }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Mathf.Abs.html</summary>
    public struct Mathf
    {
        public static float Abs(float f) => Math.Abs(f);
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/MonoBehaviour.html</summary>
    public class MonoBehaviour : Behaviour
    {
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Component.html</summary>
    public class Component : Object
    {
        public readonly GameObject Owner = new GameObject();
        public Transform transform => Owner.transform;
        public GameObject gameObject => Owner;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Behaviour.html</summary>
    public class Behaviour : Component
    {
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/GameObject.html</summary>
    public sealed class GameObject : Object
    {
        public readonly Transform Placed = new Transform();
        public int layer { get; set; }
        public SceneManagement.Scene scene { get; set; }
        public Transform transform => Placed;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Transform.html</summary>
    public class Transform : Object
    {
        public Vector3 position { get; set; }
        public Vector3 forward { get; set; }
        public Vector3 up { get; set; }
        public Quaternion rotation { get; set; } = new Quaternion(0, 0, 0, 1);

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
        public static double fixedTimeAsDouble { get; set; }
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

        public static Vector3 operator +(Vector3 a, Vector3 b) => new Vector3(a.x + b.x, a.y + b.y, a.z + b.z);
        public static Vector3 operator -(Vector3 a, Vector3 b) => new Vector3(a.x - b.x, a.y - b.y, a.z - b.z);
        public static Vector3 operator *(Vector3 a, float d) => new Vector3(a.x * d, a.y * d, a.z * d);

        public static Vector3 Lerp(Vector3 a, Vector3 b, float t) => a + (b - a) * Math.Max(0, Math.Min(t, 1));

        public static Vector3 Cross(Vector3 lhs, Vector3 rhs)
        {
            return new Vector3(lhs.y * rhs.z - lhs.z * rhs.y, lhs.z * rhs.x - lhs.x * rhs.z, lhs.x * rhs.y - lhs.y * rhs.x);
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Vector2.html</summary>
    public struct Vector2
    {
        public float x, y;

        public Vector2(float x, float y)
        {
            this.x = x;
            this.y = y;
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Quaternion.html</summary>
    public struct Quaternion
    {
        public float x, y, z, w;

        public Quaternion(float x, float y, float z, float w)
        {
            this.x = x;
            this.y = y;
            this.z = z;
            this.w = w;
        }

        public static Quaternion LookRotation(Vector3 forward, Vector3 upwards)
        {
            forward = Normalized(forward);
            Vector3 right = Normalized(Vector3.Cross(upwards, forward)), up = Vector3.Cross(forward, right);
            // The largest component by the diagonal of the matrix, the others by its other elements (Shepperd 1978).
            double x2 = 1.0 + right.x - up.y - forward.z, y2 = 1.0 - right.x + up.y - forward.z, z2 = 1.0 - right.x - up.y + forward.z, w2 = 1.0 + right.x + up.y + forward.z;
            double wx = up.z - forward.y, wy = forward.x - right.z, wz = right.y - up.x, xy = right.y + up.x, xz = forward.x + right.z, yz = up.z + forward.y;
            var largest = Math.Max(Math.Max(x2, y2), Math.Max(z2, w2));
            return largest == w2 ? Scaled(wx, wy, wz, w2, w2) : largest == x2 ? Scaled(x2, xy, xz, wx, x2) : largest == y2 ? Scaled(xy, y2, yz, wy, y2) : Scaled(xz, yz, z2, wz, z2);
        }

        private static Quaternion Scaled(double x, double y, double z, double w, double square)
        {
            var scale = 0.5 / Math.Sqrt(square);
            return new Quaternion((float)(x * scale), (float)(y * scale), (float)(z * scale), (float)(w * scale));
        }

        public static Quaternion Slerp(Quaternion a, Quaternion b, float t)
        {
            t = Math.Max(0, Math.Min(t, 1));
            var cosine = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
            if (cosine < 0) b = new Quaternion(-b.x, -b.y, -b.z, -b.w);
            var angle = Math.Acos(Math.Min(Math.Abs(cosine), 1));
            double sine = Math.Sin(angle), first = sine < 1e-4 ? 1 - t : Math.Sin((1 - t) * angle) / sine, second = sine < 1e-4 ? t : Math.Sin(t * angle) / sine;
            return new Quaternion((float)(first * a.x + second * b.x), (float)(first * a.y + second * b.y), (float)(first * a.z + second * b.z), (float)(first * a.w + second * b.w));
        }

        public static Quaternion AngleAxis(float angle, Vector3 axis)
        {
            axis = Normalized(axis);
            double half = angle * Math.PI / 360, sine = Math.Sin(half);
            return new Quaternion((float)(axis.x * sine), (float)(axis.y * sine), (float)(axis.z * sine), (float)Math.Cos(half));
        }

        public static Quaternion operator *(Quaternion a, Quaternion b)
        {
            return new Quaternion(a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                                  a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z);
        }

        public static Vector3 operator *(Quaternion rotation, Vector3 point)
        {
            Vector3 axis = new Vector3(rotation.x, rotation.y, rotation.z), twice = Vector3.Cross(axis, point) * 2;
            return point + twice * rotation.w + Vector3.Cross(axis, twice);
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
    public sealed unsafe class Texture2DArray : Texture
    {
        public readonly int Side, Depth;
        public readonly bool HasMipmaps, IsLinear;
        public readonly TextureFormat Format;
        private readonly byte*[] levels;  // in system memory
        private readonly byte[][] sent;   // what Apply() sent to the GPU
        private readonly int bytes;
        private IntPtr memory;
        public int Applied;
        /// <summary>Bytes that SetPixelData() copied, of all textures.</summary>
        public static long Copied;
        /// <summary>Position of the first texel within 64 bytes, of textures that are made from now on.</summary>
        public static int Misalignment;
        /// <summary>Number of textures that are not destroyed.</summary>
        public static int Live;

        public int mipmapCount { get; }

        public Texture2DArray(int width, int height, int depth, TextureFormat textureFormat, bool mipChain, bool linear)
        {
            Side = width;
            Depth = depth;
            Format = textureFormat;
            HasMipmaps = mipChain;
            IsLinear = linear;
            mipmapCount = 1;
            while (mipChain && width >> mipmapCount > 0) ++mipmapCount;
            levels = new byte*[depth * mipmapCount];
            sent = new byte[levels.Length][];
            for (var i = 0; i < levels.Length; ++i)
            {
                sent[i] = new byte[Bytes(i % mipmapCount)];
                bytes += sent[i].Length;
            }
            memory = Marshal.AllocHGlobal(bytes + 128);
            ++Live;
            var at = (byte*)(((long)memory + 63) / 64 * 64 + Misalignment);
            for (var i = 0; i < levels.Length; ++i)
            {
                levels[i] = at;
                at += sent[i].Length;
            }
        }

        private int Bytes(int mipLevel) => (Side >> mipLevel) * (Side >> mipLevel) * (Format == TextureFormat.RGBAHalf ? 8 : 4);

        protected override void End()
        {
            if (memory == IntPtr.Zero) throw new InvalidOperationException("The texture was destroyed before.");
            Marshal.FreeHGlobal(memory);
            memory = IntPtr.Zero;
            --Live;
        }

        public NativeArray<T> GetPixelData<T>(int mipLevel, int element) where T : struct
        {
            if (memory == IntPtr.Zero) throw new InvalidOperationException("The texture was destroyed.");
            return new NativeArray<T> { Pointer = levels[element * mipmapCount + mipLevel], Length = Bytes(mipLevel) / Marshal.SizeOf(typeof(T)) };
        }

        public void SetPixelData<T>(NativeArray<T> data, int mipLevel, int element, int sourceDataStartIndex = 0) where T : struct
        {
            var count = Bytes(mipLevel);
            if (data.Length * Marshal.SizeOf(typeof(T)) != count) throw new ArgumentException("The data has another size than the level.");
            Buffer.MemoryCopy(data.Pointer, levels[element * mipmapCount + mipLevel], count, count);
            Copied += count;
        }

        /// <summary>What shaders see of a level.</summary>
        public ReadOnlySpan<byte> Sent(int mipLevel, int element) => sent[element * mipmapCount + mipLevel];

        public void Apply(bool updateMipmaps = true, bool makeNoLongerReadable = false)
        {
            if (updateMipmaps || makeNoLongerReadable) throw new ArgumentException("The mipmaps are those of the library.");
            for (var i = 0; i < levels.Length; ++i) Marshal.Copy((IntPtr)levels[i], sent[i], 0, sent[i].Length);
            ++Applied;
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
        public bool isReadable { get; set; } = true;
        public Vector3[] vertices { get; set; }
        public int[] triangles { get; set; }
        public int subMeshCount { get; set; }

        public void SetIndices(ushort[] indices, MeshTopology topology, int submesh, bool calculateBounds = true, int baseVertex = 0) => Submeshes[submesh] = indices;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Material.html</summary>
    public class Material : Object
    {
        private readonly ShaderValues values = new ShaderValues();
        public object this[string name] => values[name];
        public void SetVector(int nameID, Vector4 value) => values.Vectors[nameID] = value;
        public void SetVectorArray(int nameID, Vector4[] values) => this.values.Objects[nameID] = values;
        public void SetTexture(int nameID, Texture value) => values.Objects[nameID] = value;
    }

    /// <summary>Of the stubs: properties of a material, or global ones.</summary>
    public sealed class ShaderValues
    {
        public readonly Dictionary<int, Vector4> Vectors = new Dictionary<int, Vector4>();
        public readonly Dictionary<int, object> Objects = new Dictionary<int, object>();

        public object this[string name]
        {
            get
            {
                var nameID = Shader.PropertyToID(name);
                return Objects.TryGetValue(nameID, out var found) ? found : Vectors[nameID];
            }
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/MaterialPropertyBlock.html</summary>
    public sealed class MaterialPropertyBlock
    {
        private readonly Dictionary<int, Vector4[]> values = new Dictionary<int, Vector4[]>();
        public Vector4[] this[string name] => values[Shader.PropertyToID(name)];

        public void SetVectorArray(int nameID, Vector4[] values)
        {
            Vector4[] copy;
            if (!this.values.TryGetValue(nameID, out copy)) this.values[nameID] = copy = new Vector4[values.Length];
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
        public static readonly ShaderValues Globals = new ShaderValues();

        public static int PropertyToID(string name)
        {
            if (!names.Contains(name)) names.Add(name);
            return names.IndexOf(name);
        }

        public static void SetGlobalTexture(int nameID, Texture value) => Globals.Objects[nameID] = value;
        public static void SetGlobalVectorArray(int nameID, Vector4[] values) => Globals.Objects[nameID] = values;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/ForceMode.html</summary>
    public enum ForceMode
    {
        Force = 0,
        Impulse = 1,
        VelocityChange = 2,
        Acceleration = 5,
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Physics.html</summary>
    public class Physics
    {
        public static int Synchronised;
        public static Vector3 gravity { get; set; } = new Vector3(0, -9.81f, 0);
        public static void SyncTransforms() => ++Synchronised;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Rigidbody.html</summary>
    public sealed class Rigidbody : Component
    {
        private Vector3 velocity;

        public float mass { get; set; }
        public bool useGravity { get; set; } = true;
        public Vector3 centerOfMass { get; set; }
        public Vector3 worldCenterOfMass => position + rotation * centerOfMass;
        public Vector3 angularVelocity { get; set; }
        public Vector3 position { get; set; }
        public Quaternion rotation { get; set; } = new Quaternion(0, 0, 0, 1);
        public Vector3 GetPointVelocity(Vector3 worldPoint) => velocity + Vector3.Cross(angularVelocity, worldPoint - worldCenterOfMass);

        public void AddForce(Vector3 force, ForceMode mode)
        {
            if (mode != ForceMode.VelocityChange) throw new NotSupportedException();
            velocity += force;
        }

        public void AddTorque(Vector3 torque, ForceMode mode)
        {
            if (mode != ForceMode.VelocityChange) throw new NotSupportedException();
            angularVelocity += torque;
        }

        /// <summary>A step of physics: velocities, then positions.</summary>
        public void Simulate(float stepS)
        {
            if (useGravity) velocity += Physics.gravity * stepS;
            var centre = worldCenterOfMass + velocity * stepS;
            var turn = angularVelocity;
            var speed = (float)Math.Sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
            if (speed > 0) rotation = Quaternion.AngleAxis((float)(speed * stepS * 180 / Math.PI), turn) * rotation;
            position = centre - rotation * centerOfMass;
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Color32.html</summary>
    public struct Color32
    {
        public byte r, g, b, a;

        public Color32(byte r, byte g, byte b, byte a)
        {
            this.r = r;
            this.g = g;
            this.b = b;
            this.a = a;
        }
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/ParticleSystem.html</summary>
    public sealed class ParticleSystem : Component
    {
        public Particle[] Shown;
        public int Count;

        /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/ParticleSystem.Particle.html</summary>
        public struct Particle
        {
            public Vector3 position { get; set; }
            public Vector3 velocity { get; set; }
            public float startSize { get; set; }
            public Color32 startColor { get; set; }
            public float startLifetime { get; set; }
            public float remainingLifetime { get; set; }
        }

        public void SetParticles(Particle[] particles, int size)
        {
            Shown = particles;
            Count = size;
        }
    }
}

namespace UnityEngine.SceneManagement
{
    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/SceneManagement.Scene.html</summary>
    public struct Scene
    {
        public GameObject[] Roots;

        public void GetRootGameObjects(List<GameObject> rootGameObjects)
        {
            rootGameObjects.Clear();
            rootGameObjects.AddRange(Roots);
        }
    }
}

namespace UnityEditor
{
    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Editor.html</summary>
    public class Editor : UnityEngine.Object
    {
        public UnityEngine.Object target { get; set; }
        public virtual void OnInspectorGUI() => throw new NotSupportedException();
        public virtual bool RequiresConstantRepaint() => false;
        public bool DrawDefaultInspector() => false;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/CustomEditor.html</summary>
    [AttributeUsage(AttributeTargets.Class)]
    public sealed class CustomEditor : Attribute
    {
        public readonly Type Inspected;
        public CustomEditor(Type inspectedType) => Inspected = inspectedType;
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/MessageType.html</summary>
    public enum MessageType
    {
        None,
        Info,
        Warning,
        Error,
    }

    /// <summary>https://docs.unity3d.com/2022.3/Documentation/ScriptReference/EditorGUILayout.HelpBox.html</summary>
    public sealed class EditorGUILayout
    {
        public static readonly List<(string message, MessageType type)> Boxes = new List<(string, MessageType)>();
        public static void HelpBox(string message, MessageType type) => Boxes.Add((message, type));
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
