using System;
using System.Runtime.InteropServices;

namespace Pelagic
{
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
        private static readonly WaterCall.Function exactWater = Native.pelagic_exact_water_sample;
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

        /// <summary>Shifts the world's origin, as Ocean.SetOrigin(), for samples from now on.</summary>
        public void SetOrigin(double xM, double zM)
        {
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_exact_water_set_origin(use.Pointer, xM, zM));
        }

        /// <summary>
        /// Samples the water at points in the world, none of them below the sea floor, without waves shorter than the
        /// footprint.
        /// </summary>
        public void Sample(ReadOnlySpan<double> x, ReadOnlySpan<double> y, ReadOnlySpan<double> z, WaterSamples samples, double footprintM = 0)
        {
            var points = new Native.pelagic_water_points { struct_size = (uint)sizeof(Native.pelagic_water_points), footprint_m = footprintM };
            WaterCall.Sample(exactWater, handle, ref points, x, y, z, samples);
        }

        /// <summary>Heights of the surface, which is not displaced. Footprint as Sample().</summary>
        public void SampleHeights(ReadOnlySpan<double> x, ReadOnlySpan<double> z, Span<float> heightM, double footprintM = 0)
        {
            if (z.Length != x.Length) throw new ArgumentException("x and z differ in length.");
            WaterCall.RequireRoom(x.Length, heightM.Length);
            fixed (double* xs = &MemoryMarshal.GetReference(x), zs = &MemoryMarshal.GetReference(z))
            fixed (float* height = &MemoryMarshal.GetReference(heightM))
            {
                var points = new Native.pelagic_points
                {
                    struct_size = (uint)sizeof(Native.pelagic_points),
                    footprint_m = footprintM,
                    count = (UIntPtr)x.Length,
                    x = xs,
                    z = zs,
                };
                var wanted = new Native.pelagic_samples { struct_size = (uint)sizeof(Native.pelagic_samples), height_m = height };
                using (var use = new Use(handle)) Errors.Check(Native.pelagic_exact_water_sample_surface(use.Pointer, &points, &wanted));
            }
        }

        public void Dispose()
        {
            handle.Dispose();
        }
    }
}
