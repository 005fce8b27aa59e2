using System;
using Unity.Collections;
using Unity.Collections.LowLevel.Unsafe;
using Unity.Jobs;
using UnityEngine;

namespace Pelagic.Unity
{
    /// <summary>
    /// Samples the surface at many positions with Unity's jobs. Positions and results are in the scene's axes, whose
    /// z axis is -z of the sea. One thread calls the methods.
    ///
    /// The jobs read the frame completed last: call Complete() before the next Ocean.Complete(). They use pointers,
    /// which Unity does not check: arrays must stay allocated until Complete().
    /// </summary>
    public sealed unsafe class OceanQueries : IDisposable
    {
        /// <summary>Positions of one job.</summary>
        public const int BatchSize = 64;

        private readonly Use use;
        private JobHandle handle;
        private bool isDisposed;

        /// <summary>The ocean of the queries. An OceanBehaviour creates another when its options change.</summary>
        public Ocean Ocean { get; }

        /// <summary>Keeps the ocean's memory until Dispose(). The ocean needs OceanOptions.Queries.</summary>
        public OceanQueries(Ocean ocean)
        {
            Ocean = ocean ?? throw new ArgumentNullException(nameof(ocean));
            use = new Use(ocean.Handle);
        }

        /// <summary>
        /// Starts jobs and returns immediately. Allocates nothing. Heights, normals and velocities have an element for
        /// each position; an array that was not created is left out. Velocities, in m/s, need
        /// OceanOptions.Velocities. The y of positions has no effect. Throws a PelagicException before the first frame.
        /// </summary>
        public JobHandle Schedule(NativeArray<Vector3> positions, NativeArray<float> heights, NativeArray<Vector3> normals = default,
                                  NativeArray<Vector3> velocities = default, JobHandle dependsOn = default)
        {
            if (isDisposed) throw new ObjectDisposedException(nameof(OceanQueries));
            Complete();
            var count = positions.Length;
            RequireRoom(heights.IsCreated, heights.Length, count);
            RequireRoom(normals.IsCreated, normals.Length, count);
            RequireRoom(velocities.IsCreated, velocities.Length, count);
            var job = new Job
            {
                Ocean = use.Pointer,
                Count = count,
                Positions = (Vector3*)positions.GetUnsafeReadOnlyPtr(),
                Heights = heights.IsCreated ? (float*)heights.GetUnsafePtr() : null,
                Normals = normals.IsCreated ? (Vector3*)normals.GetUnsafePtr() : null,
                Velocities = velocities.IsCreated ? (Vector3*)velocities.GetUnsafePtr() : null,
            };
            job.Check();
            handle = job.Schedule((count + BatchSize - 1) / BatchSize, 1, dependsOn);
            return handle;
        }

        /// <summary>Waits for the jobs scheduled last.</summary>
        public void Complete()
        {
            handle.Complete();
            handle = default;
        }

        /// <summary>Waits for jobs, and releases the ocean.</summary>
        public void Dispose()
        {
            if (isDisposed) return;
            isDisposed = true;
            Complete();
            use.Dispose();
        }

        private static void RequireRoom(bool isCreated, int length, int count)
        {
            if (isCreated && length < count) throw new ArgumentException("An array of results is shorter than the positions.");
        }

        /// <summary>Samples BatchSize positions for each index.</summary>
        private struct Job : IJobParallelFor
        {
            // The safety system follows no pointers.
            [NativeDisableUnsafePtrRestriction] public IntPtr Ocean;
            [NativeDisableUnsafePtrRestriction] public Vector3* Positions;
            [NativeDisableUnsafePtrRestriction] public float* Heights;
            [NativeDisableUnsafePtrRestriction] public Vector3* Normals;
            [NativeDisableUnsafePtrRestriction] public Vector3* Velocities;
            public int Count;

            public void Execute(int index)
            {
                var first = index * BatchSize;
                var count = Count - first < BatchSize ? Count - first : BatchSize;
                double* x = stackalloc double[BatchSize], z = stackalloc double[BatchSize];
                float* vectors = stackalloc float[6 * BatchSize];
                for (var i = 0; i < count; ++i)
                {
                    x[i] = Positions[first + i].x;
                    z[i] = -Positions[first + i].z;
                }
                // Check() found no error, and those of a query do not depend on positions.
                Query(count, x, z, Heights == null ? null : Heights + first, vectors);
                for (var i = 0; i < count; ++i)
                {
                    if (Normals != null) Normals[first + i] = InScene(vectors + i);
                    if (Velocities != null) Velocities[first + i] = InScene(vectors + 3 * BatchSize + i);
                }
            }

            /// <summary>Throws for an invalid query, which jobs cannot do.</summary>
            internal void Check()
            {
                double x = 0, z = 0;
                float height;
                float* vectors = stackalloc float[6 * BatchSize];
                Errors.Check(Query(1, &x, &z, &height, vectors));
            }

            /// <summary>Writes normals, then velocities, each as BatchSize values of x, of y and of z.</summary>
            private Status Query(int count, double* x, double* z, float* heights, float* vectors)
            {
                float* normals = Normals == null ? null : vectors, velocities = Velocities == null ? null : vectors + 3 * BatchSize;
                var points = new Native.pelagic_points
                {
                    struct_size = (uint)sizeof(Native.pelagic_points),
                    count = (UIntPtr)count,
                    x = x,
                    z = z,
                };
                var samples = new Native.pelagic_samples
                {
                    struct_size = (uint)sizeof(Native.pelagic_samples),
                    height_m = heights,
                    normal_x = normals,
                    normal_y = normals == null ? null : normals + BatchSize,
                    normal_z = normals == null ? null : normals + 2 * BatchSize,
                    velocity_x_mps = velocities,
                    velocity_y_mps = velocities == null ? null : velocities + BatchSize,
                    velocity_z_mps = velocities == null ? null : velocities + 2 * BatchSize,
                };
                return Native.pelagic_ocean_query(Ocean, &points, &samples);
            }

            private static Vector3 InScene(float* vector)
            {
                // A NaN keeps its bits, as in every language.
                var z = vector[2 * BatchSize];
                return new Vector3(vector[0], vector[BatchSize], float.IsNaN(z) ? z : -z);
            }
        }
    }
}
