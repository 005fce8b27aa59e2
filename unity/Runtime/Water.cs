using System;
using System.Runtime.InteropServices;

namespace Pelagic
{
    /// <summary>
    /// Arrays that receive water at points, each as long as the points. An empty span leaves a result out. Above the
    /// surface the pressure is 0, and velocity and acceleration are those at the surface.
    /// </summary>
    public ref struct WaterSamples
    {
        /// <summary>Depth below the surface above the point; negative in the air.</summary>
        public Span<float> DepthM;
        /// <summary>Pressure above that of the air.</summary>
        public Span<float> PressurePa;
        /// <summary>The water's own velocity, not scaled by choppiness.</summary>
        public Span<float> VelocityXMps, VelocityYMps, VelocityZMps;
        public Span<float> AccelerationXMps2, AccelerationYMps2, AccelerationZMps2;
    }

    public sealed unsafe partial class Ocean
    {
        private static readonly WaterCall.Function frameWater = Native.pelagic_ocean_sample_water;

        /// <summary>
        /// Samples the water of the frame completed last at points in the world, none of them below the sea floor;
        /// with OceanOptions.Depth. Threads and footprint as Query(). Allocates nothing.
        /// </summary>
        public void SampleWater(ReadOnlySpan<double> x, ReadOnlySpan<double> y, ReadOnlySpan<double> z, WaterSamples samples,
                                Interpolation interpolation = Interpolation.Linear, double waterDensityKgpm3 = 1025, double footprintM = 0)
        {
            var points = new Native.pelagic_water_points
            {
                struct_size = (uint)sizeof(Native.pelagic_water_points),
                interpolation = interpolation,
                water_density_kgpm3 = waterDensityKgpm3,
                footprint_m = footprintM,
            };
            WaterCall.Sample(frameWater, handle, ref points, x, y, z, samples);
        }
    }

    /// <summary>Calls a function of the library with spans as its arrays.</summary>
    internal static unsafe class WaterCall
    {
        internal delegate Status Function(IntPtr water, Native.pelagic_water_points* points, Native.pelagic_water_samples* samples);

        internal static void Sample(Function function, SafeHandle handle, ref Native.pelagic_water_points points, ReadOnlySpan<double> x,
                                    ReadOnlySpan<double> y, ReadOnlySpan<double> z, WaterSamples samples)
        {
            if (y.Length != x.Length || z.Length != x.Length) throw new ArgumentException("x, y and z differ in length.");
            RequireRoom(x.Length, samples);
            fixed (double* xs = &MemoryMarshal.GetReference(x), ys = &MemoryMarshal.GetReference(y), zs = &MemoryMarshal.GetReference(z))
            fixed (float* depth = &MemoryMarshal.GetReference(samples.DepthM), pressure = &MemoryMarshal.GetReference(samples.PressurePa),
                   velocityX = &MemoryMarshal.GetReference(samples.VelocityXMps), velocityY = &MemoryMarshal.GetReference(samples.VelocityYMps),
                   velocityZ = &MemoryMarshal.GetReference(samples.VelocityZMps),
                   accelerationX = &MemoryMarshal.GetReference(samples.AccelerationXMps2),
                   accelerationY = &MemoryMarshal.GetReference(samples.AccelerationYMps2),
                   accelerationZ = &MemoryMarshal.GetReference(samples.AccelerationZMps2))
            {
                points.count = (UIntPtr)x.Length;
                points.x = xs;
                points.y = ys;
                points.z = zs;
                var wanted = new Native.pelagic_water_samples
                {
                    struct_size = (uint)sizeof(Native.pelagic_water_samples),
                    depth_m = depth,
                    pressure_pa = pressure,
                    velocity_x_mps = velocityX,
                    velocity_y_mps = velocityY,
                    velocity_z_mps = velocityZ,
                    acceleration_x_mps2 = accelerationX,
                    acceleration_y_mps2 = accelerationY,
                    acceleration_z_mps2 = accelerationZ,
                };
                using (var use = new Use(handle))
                fixed (Native.pelagic_water_points* at = &points)
                    Errors.Check(function(use.Pointer, at, &wanted));
            }
        }

        internal static void RequireRoom(int count, in WaterSamples samples)
        {
            RequireRoom(count, samples.DepthM.Length);
            RequireRoom(count, samples.PressurePa.Length);
            RequireRoom(count, samples.VelocityXMps.Length);
            RequireRoom(count, samples.VelocityYMps.Length);
            RequireRoom(count, samples.VelocityZMps.Length);
            RequireRoom(count, samples.AccelerationXMps2.Length);
            RequireRoom(count, samples.AccelerationYMps2.Length);
            RequireRoom(count, samples.AccelerationZMps2.Length);
        }

        internal static void RequireRoom(int count, int length)
        {
            if (length != 0 && length < count) throw new ArgumentException("A span of samples is shorter than the points.");
        }
    }
}
