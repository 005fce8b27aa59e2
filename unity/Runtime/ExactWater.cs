using System;
using System.Runtime.InteropServices;

namespace Pelagic
{
    /// <summary>
    /// Arrays that receive water at points, each as long as the points. An empty span leaves a result out. Above the
    /// surface, pressure, velocity and acceleration are 0.
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

    public sealed class ExactWaterOptions
    {
        /// <summary>Density of the water; [500, 2000].</summary>
        public double WaterDensityKgpm3 = Native.pelagic_exact_water_options_make().water_density_kgpm3;
        /// <summary>Sea level and current.</summary>
        public WaterFrame WaterFrame;
        /// <summary>Computes the waves; null: the calling thread.</summary>
        public Executor Executor;
    }

    /// <summary>
    /// The exact sum over the waves of a sea at one moment: pressure, velocity and acceleration of the water at any
    /// position and depth, by linear theory at fixed positions. A point takes some 25 microseconds with four cascades
    /// of 128. Any number of threads may sample, but not during SetTime().
    /// </summary>
    public sealed unsafe class ExactWater : IDisposable
    {
        private readonly ExactWaterHandle handle;

        /// <summary>Computes the waves of a sea, which is no pond, and moves them to the time 0.</summary>
        public ExactWater(Sea sea, ExactWaterOptions options = null)
        {
            options = options ?? new ExactWaterOptions();
            sea.struct_size = (uint)sizeof(Sea);
            var frame = options.WaterFrame;
            frame.struct_size = (uint)sizeof(WaterFrame);
            IntPtr water;
            using (var executor = new Use(options.Executor?.Handle))
            {
                var native = Native.pelagic_exact_water_options_make();
                native.water_density_kgpm3 = options.WaterDensityKgpm3;
                native.water_frame = &frame;
                native.executor = executor.Pointer;
                Errors.Check(Native.pelagic_exact_water_create(&sea, &native, &water));
            }
            var root = options.Executor?.Root;
            root?.Add();
            handle = new ExactWaterHandle(water, root == null ? new CallbackRoot[0] : new[] { root });
        }

        /// <summary>Moves the water to a time, which takes about as long as a point.</summary>
        public void SetTime(double timeS)
        {
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_exact_water_set_time(use.Pointer, timeS));
        }

        /// <summary>Samples the water at points in the world, none of them below the sea floor.</summary>
        public void Sample(ReadOnlySpan<double> x, ReadOnlySpan<double> y, ReadOnlySpan<double> z, WaterSamples samples)
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
                var points = new Native.pelagic_water_points
                {
                    struct_size = (uint)sizeof(Native.pelagic_water_points),
                    count = (UIntPtr)x.Length,
                    x = xs,
                    y = ys,
                    z = zs,
                };
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
                using (var use = new Use(handle)) Errors.Check(Native.pelagic_exact_water_sample(use.Pointer, &points, &wanted));
            }
        }

        /// <summary>Heights of the surface, which is not displaced.</summary>
        public void SampleHeights(ReadOnlySpan<double> x, ReadOnlySpan<double> z, Span<float> heightM)
        {
            if (z.Length != x.Length) throw new ArgumentException("x and z differ in length.");
            RequireRoom(x.Length, heightM.Length);
            fixed (double* xs = &MemoryMarshal.GetReference(x), zs = &MemoryMarshal.GetReference(z))
            fixed (float* height = &MemoryMarshal.GetReference(heightM))
            {
                var points = new Native.pelagic_points { struct_size = (uint)sizeof(Native.pelagic_points), count = (UIntPtr)x.Length, x = xs, z = zs };
                var wanted = new Native.pelagic_samples { struct_size = (uint)sizeof(Native.pelagic_samples), height_m = height };
                using (var use = new Use(handle)) Errors.Check(Native.pelagic_exact_water_sample_surface(use.Pointer, &points, &wanted));
            }
        }

        public void Dispose()
        {
            handle.Dispose();
        }

        private static void RequireRoom(int count, in WaterSamples samples)
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

        private static void RequireRoom(int count, int length)
        {
            if (length != 0 && length < count) throw new ArgumentException("A span of samples is shorter than the points.");
        }
    }
}
