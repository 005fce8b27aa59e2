using System;
using System.Runtime.InteropServices;

namespace Pelagic
{
    /// <summary>
    /// Arrays that receive the results of a query, each as long as the points. An empty span leaves a result out.
    /// </summary>
    public ref struct Samples
    {
        public Span<float> HeightM;
        /// <summary>Unit normal of the displaced surface.</summary>
        public Span<float> NormalX, NormalY, NormalZ;
        /// <summary>1 at rest, small at sharp crests, negative where overturned.</summary>
        public Span<float> Jacobian;
        /// <summary>Velocity of the water; with OceanOptions.Velocities.</summary>
        public Span<float> VelocityXMps, VelocityYMps, VelocityZMps;
        /// <summary>Horizontal distance from the point to the sample's drawn position.</summary>
        public Span<float> ErrorM;
        /// <summary>1 if the error is within the tolerance.</summary>
        public Span<byte> Converged;
        /// <summary>Fraction covered by foam; with OceanOptions.Foam, DynamicWaves or Shore.</summary>
        public Span<float> Foam;
    }

    public sealed unsafe partial class Ocean
    {
        /// <summary>
        /// Samples the surface of the frame completed last at positions in the world, in metres. Any number of
        /// threads may query, also while others schedule, complete or dispose. Allocates nothing. A footprint leaves
        /// out waves shorter than about that length, with OceanOptions.Depth; velocities are then the water's own.
        /// </summary>
        public void Query(ReadOnlySpan<double> x, ReadOnlySpan<double> z, Samples samples, Interpolation interpolation = Interpolation.Linear,
                          double footprintM = 0)
        {
            if (z.Length != x.Length) throw new ArgumentException("x and z differ in length.");
            RequireRoom(x.Length, samples);
            fixed (double* xs = &MemoryMarshal.GetReference(x), zs = &MemoryMarshal.GetReference(z))
            fixed (float* height = &MemoryMarshal.GetReference(samples.HeightM), normalX = &MemoryMarshal.GetReference(samples.NormalX),
                   normalY = &MemoryMarshal.GetReference(samples.NormalY), normalZ = &MemoryMarshal.GetReference(samples.NormalZ),
                   jacobian = &MemoryMarshal.GetReference(samples.Jacobian), velocityX = &MemoryMarshal.GetReference(samples.VelocityXMps),
                   velocityY = &MemoryMarshal.GetReference(samples.VelocityYMps), velocityZ = &MemoryMarshal.GetReference(samples.VelocityZMps),
                   error = &MemoryMarshal.GetReference(samples.ErrorM), foam = &MemoryMarshal.GetReference(samples.Foam))
            fixed (byte* converged = &MemoryMarshal.GetReference(samples.Converged))
            {
                var wanted = new Native.pelagic_samples
                {
                    struct_size = (uint)sizeof(Native.pelagic_samples),
                    height_m = height,
                    normal_x = normalX,
                    normal_y = normalY,
                    normal_z = normalZ,
                    jacobian = jacobian,
                    velocity_x_mps = velocityX,
                    velocity_y_mps = velocityY,
                    velocity_z_mps = velocityZ,
                    error_m = error,
                    converged = converged,
                    foam = foam,
                };
                Query(x.Length, xs, zs, ref wanted, interpolation, footprintM);
            }
        }

        /// <summary>
        /// Samples heights as Query(), through pointers to `count` elements each. A null pointer leaves a result out.
        /// </summary>
        public void QueryHeights(int count, double* x, double* z, float* heightM, Interpolation interpolation = Interpolation.Linear,
                                 double footprintM = 0)
        {
            if (count < 0) throw new ArgumentOutOfRangeException(nameof(count));
            var wanted = new Native.pelagic_samples { struct_size = (uint)sizeof(Native.pelagic_samples), height_m = heightM };
            Query(count, x, z, ref wanted, interpolation, footprintM);
        }

        /// <summary>Height of the surface at a position.</summary>
        public float HeightAt(double x, double z)
        {
            float height;
            QueryHeights(1, &x, &z, &height);
            return height;
        }

        /// <summary>
        /// Finds the first intersection of a ray with the surface of the frame completed last. Threads as Query().
        /// </summary>
        public Hit FirstHit(Ray ray)
        {
            ray.struct_size = (uint)sizeof(Ray);
            Hit hit;
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_ocean_first_hit(use.Pointer, &ray, &hit));
            return hit;
        }

        private void Query(int count, double* x, double* z, ref Native.pelagic_samples wanted, Interpolation interpolation, double footprintM)
        {
            var points = new Native.pelagic_points
            {
                struct_size = (uint)sizeof(Native.pelagic_points),
                count = (UIntPtr)count,
                x = x,
                z = z,
                interpolation = interpolation,
                footprint_m = footprintM,
            };
            using (var use = new Use(handle))
            fixed (Native.pelagic_samples* samples = &wanted)
                Errors.Check(Native.pelagic_ocean_query(use.Pointer, &points, samples));
        }

        private static void RequireRoom(int count, in Samples samples)
        {
            RequireRoom(count, samples.HeightM.Length);
            RequireRoom(count, samples.NormalX.Length);
            RequireRoom(count, samples.NormalY.Length);
            RequireRoom(count, samples.NormalZ.Length);
            RequireRoom(count, samples.Jacobian.Length);
            RequireRoom(count, samples.VelocityXMps.Length);
            RequireRoom(count, samples.VelocityYMps.Length);
            RequireRoom(count, samples.VelocityZMps.Length);
            RequireRoom(count, samples.ErrorM.Length);
            RequireRoom(count, samples.Converged.Length);
            RequireRoom(count, samples.Foam.Length);
        }

        private static void RequireRoom(int count, int length)
        {
            if (length != 0 && length < count) throw new ArgumentException("A span of samples is shorter than the points.");
        }
    }
}
