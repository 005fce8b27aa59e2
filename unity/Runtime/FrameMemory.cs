using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace Pelagic
{
    /// <summary>
    /// Arrays that receive a cascade of N^2 texels, in tight rows: texel (i, j) is element j N + i. Null leaves an
    /// array out.
    /// </summary>
    public sealed class CascadeArrays
    {
        /// <summary>N^2 values.</summary>
        public float[] Dx, Height, Dz, VelocityX, VelocityY, VelocityZ;
        /// <summary>4 N^2 values.</summary>
        public ushort[] DisplacementRgba16f;
        /// <summary>Chains of (4 N^2 - 1) / 3 texels.</summary>
        public uint[] GradientRgba8, SlopesRgba8, MomentsRgba8;
    }

    /// <summary>
    /// Memory of the application that receives the textures of a cascade, for instance of mapped buffers. Each byte is
    /// written once and none is read. A texture whose pointer is zero, or whose array is null, is part of the frame.
    /// </summary>
    public struct TextureTargets
    {
        /// <summary>8 N^2 bytes in tight rows, at a multiple of 64 bytes.</summary>
        public IntPtr DisplacementRgba16f;
        /// <summary>Pointers to the levels of the chains, at multiples of 4 bytes.</summary>
        public IntPtr[] GradientRgba8, SlopesRgba8, MomentsRgba8;
    }

    public sealed unsafe partial class Ocean
    {
        private const int MaxLevels = 12, MaxCascades = 4;
        private readonly Native.pelagic_texture_targets[] targets = new Native.pelagic_texture_targets[MaxCascades];

        /// <summary>
        /// Starts a frame as Schedule(), with textures in memory of the application, which must stay valid until
        /// Complete() returns. One element for each cascade. Those textures are empty in the frame.
        /// </summary>
        public void ScheduleInto(double timeS, TextureTargets[] cascades)
        {
            if (cascades == null) throw new ArgumentNullException(nameof(cascades));
            if (cascades.Length < 1 || cascades.Length > MaxCascades) throw new ArgumentException("Targets need one element for each cascade.");
            fixed (Native.pelagic_texture_targets* first = targets)
            using (var use = new Use(handle))
            {
                for (var i = 0; i < cascades.Length; ++i) Write(cascades[i], first + i);
                first->cascade_count = cascades.Length == 1 ? 0 : (uint)cascades.Length;
                Errors.Check(Native.pelagic_ocean_schedule_into(use.Pointer, timeS, first));
            }
            Scheduled();
        }

        /// <summary>Copies the frame completed last. One element for each cascade.</summary>
        public void Copy(params CascadeArrays[] cascades)
        {
            using (var use = new Use(handle))
            using (var buffers = new Buffers(cascades))
                fixed (Native.pelagic_frame_buffers* first = buffers.Native)
                    Errors.Check(Native.pelagic_ocean_copy(use.Pointer, first));
        }

        /// <summary>
        /// Computes a frame synchronously and writes it to arrays, for servers and replays. The frame completed last
        /// stays valid, and queries continue to read it. One element for each cascade.
        /// </summary>
        public Bounds FrameAt(double timeS, params CascadeArrays[] cascades)
        {
            Bounds bounds;
            using (var use = new Use(handle))
            using (var buffers = new Buffers(cascades))
                fixed (Native.pelagic_frame_buffers* first = buffers.Native)
                    CheckWithCallbacks(Native.pelagic_ocean_frame_at(use.Pointer, timeS, first, &bounds));
            return bounds;
        }

        private static void Write(in TextureTargets target, Native.pelagic_texture_targets* native)
        {
            *native = default;
            native->struct_size = (uint)sizeof(Native.pelagic_texture_targets);
            native->displacement_rgba16f = (ushort*)target.DisplacementRgba16f;
            Write(target.GradientRgba8, &native->gradient_rgba8_0);
            Write(target.SlopesRgba8, &native->slopes_rgba8_0);
            Write(target.MomentsRgba8, &native->moments_rgba8_0);
        }

        private static void Write(IntPtr[] levels, uint** native)
        {
            if (levels == null) return;
            if (levels.Length > MaxLevels) throw new ArgumentException("A chain has at most 12 levels.");
            for (var i = 0; i < levels.Length; ++i) native[i] = (uint*)levels[i];
        }

        /// <summary>Arrays of the application, pinned until Dispose().</summary>
        private sealed class Buffers : IDisposable
        {
            internal readonly Native.pelagic_frame_buffers[] Native;
            private readonly List<GCHandle> pins = new List<GCHandle>();

            internal Buffers(CascadeArrays[] cascades)
            {
                if (cascades == null || cascades.Length == 0) throw new ArgumentException("Arrays need one element for each cascade.");
                Native = new Native.pelagic_frame_buffers[cascades.Length];
                try
                {
                    for (var i = 0; i < cascades.Length; ++i) Native[i] = Pin(cascades[i]);
                }
                catch
                {
                    Dispose();
                    throw;
                }
                Native[0].cascade_count = cascades.Length == 1 ? 0 : (uint)cascades.Length;
            }

            public void Dispose()
            {
                foreach (var pin in pins) pin.Free();
            }

            private Native.pelagic_frame_buffers Pin(CascadeArrays arrays)
            {
                return new Native.pelagic_frame_buffers
                {
                    struct_size = (uint)sizeof(Native.pelagic_frame_buffers),
                    plane_count = CountOf(arrays.Dx, arrays.Height, arrays.Dz, arrays.VelocityX, arrays.VelocityY, arrays.VelocityZ),
                    dx = (float*)Pin(arrays.Dx),
                    height = (float*)Pin(arrays.Height),
                    dz = (float*)Pin(arrays.Dz),
                    velocity_x = (float*)Pin(arrays.VelocityX),
                    velocity_y = (float*)Pin(arrays.VelocityY),
                    velocity_z = (float*)Pin(arrays.VelocityZ),
                    rgba16f_count = CountOf(arrays.DisplacementRgba16f),
                    displacement_rgba16f = (ushort*)Pin(arrays.DisplacementRgba16f),
                    rgba8_count = CountOf(arrays.GradientRgba8),
                    gradient_rgba8 = (uint*)Pin(arrays.GradientRgba8),
                    slopes_count = CountOf(arrays.SlopesRgba8, arrays.MomentsRgba8),
                    slopes_rgba8 = (uint*)Pin(arrays.SlopesRgba8),
                    moments_rgba8 = (uint*)Pin(arrays.MomentsRgba8),
                };
            }

            private void* Pin(Array array)
            {
                if (array == null) return null;
                var pin = GCHandle.Alloc(array, GCHandleType.Pinned);
                pins.Add(pin);
                return (void*)pin.AddrOfPinnedObject();
            }

            /// <summary>The length of all arrays that are not null.</summary>
            private static UIntPtr CountOf(params Array[] arrays)
            {
                var given = Array.FindAll(arrays, array => array != null);
                if (given.Length == 0) return UIntPtr.Zero;
                if (!Array.TrueForAll(given, array => array.Length == given[0].Length)) throw new ArgumentException("Arrays of a cascade differ in length.");
                return (UIntPtr)given[0].Length;
            }
        }
    }
}
