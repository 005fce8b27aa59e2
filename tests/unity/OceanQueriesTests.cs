using System;
using System.Linq;
using System.Threading;
using Pelagic;
using Pelagic.Unity;
using Unity.Collections;
using Unity.Jobs;
using UnityEngine;

public static class OceanQueriesTests
{
    // Not a multiple of the batch size.
    private const int Count = 500;

    private static NativeArray<Vector3> Positions(int count)
    {
        var positions = new NativeArray<Vector3>(count, Allocator.Persistent);
        for (var i = 0; i < count; ++i) positions[i] = new Vector3((float)(i * 37.75 % 1200 - 600), 7, (float)-(i * 12.25 % 1000 - 500));
        return positions;
    }

    [Test]
    public static void ResultsOfJobsAreThoseOfAQuery()
    {
        NativeArray<float> heights = new NativeArray<float>(Count, Allocator.Persistent);
        NativeArray<Vector3> positions = Positions(Count), normals = new NativeArray<Vector3>(Count, Allocator.Persistent),
                             velocities = new NativeArray<Vector3>(Count, Allocator.Persistent);
        using (positions)
        using (heights)
        using (normals)
        using (velocities)
        using (var ocean = new Ocean(Sea.Preset("storm"), new OceanOptions { Queries = true, Velocities = Velocities.Drawn }))
        using (var queries = new OceanQueries(ocean))
        {
            GoldenTests.FrameAt(ocean, 12.34);
            queries.Schedule(positions, heights, normals, velocities);
            queries.Complete();
            // The sea's z is mirrored.
            double[] x = new double[Count], z = new double[Count];
            for (var i = 0; i < Count; ++i)
            {
                x[i] = positions[i].x;
                z[i] = -positions[i].z;
            }
            var of = Enumerable.Range(0, 7).Select(_ => new float[Count]).ToArray();
            ocean.Query(x, z, new Samples { HeightM = of[0], NormalX = of[1], NormalY = of[2], NormalZ = of[3], VelocityXMps = of[4], VelocityYMps = of[5], VelocityZMps = of[6] });
            for (var i = 0; i < Count; ++i)
            {
                Vector3 n = normals[i], v = velocities[i];
                Check.True(new[] { heights[i], n.x, n.y, -n.z, v.x, v.y, -v.z }.SequenceEqual(of.Select(values => values[i])), $"sample {i}");
            }
            queries.Schedule(positions, default, normals).Complete();
            Check.Equal(normals[Count - 1].y, of[2][Count - 1], "the last normal, without heights");
            // All results are the quiet NaN of every language.
            positions[1] = new Vector3(0, 0, float.NaN);
            queries.Schedule(positions, heights, normals, velocities).Complete();
            Vector3 noNormal = normals[1], noVelocity = velocities[1];
            Check.Equal(Expected.Bits(heights[1], noNormal.x, noNormal.y, noNormal.z, noVelocity.x, noVelocity.y, noVelocity.z),
                        string.Join(",", Enumerable.Repeat("7fc00000", 7)), "results at no position");
        }
    }

    [Test]
    public static void AQueryAllocatesNothing()
    {
        IJobParallelForExtensions.HasThreads = false;
        try
        {
            using (var positions = Positions(Count))
            using (var heights = new NativeArray<float>(Count, Allocator.Persistent))
            using (var ocean = new Ocean(Sea.Default, new OceanOptions { Queries = true }))
            using (var queries = new OceanQueries(ocean))
            {
                GoldenTests.FrameAt(ocean, 0);
                queries.Schedule(positions, heights);
                var bytes = GC.GetAllocatedBytesForCurrentThread();
                for (var i = 0; i < 100; ++i) queries.Schedule(positions, heights).Complete();
                Check.Equal(GC.GetAllocatedBytesForCurrentThread() - bytes, 0L, "bytes of 100 queries");
            }
        }
        finally
        {
            IJobParallelForExtensions.HasThreads = true;
        }
    }

    [Test]
    public static void AnInvalidQueryIsRejectedBeforeItsJobs()
    {
        using (var positions = Positions(3))
        using (var heights = new NativeArray<float>(3, Allocator.Persistent))
        using (var few = new NativeArray<float>(2, Allocator.Persistent))
        using (var vectors = new NativeArray<Vector3>(3, Allocator.Persistent))
        using (var ocean = new Ocean(Sea.Default, new OceanOptions { Queries = true }))
        using (var queries = new OceanQueries(ocean))
        {
            Check.Equal(Check.Throws<PelagicException>(() => queries.Schedule(positions, heights), "no frame").Status, Status.WrongOrder, "status");
            GoldenTests.FrameAt(ocean, 0);
            Check.Equal(Check.Throws<PelagicException>(() => queries.Schedule(positions, heights, vectors, vectors), "no velocities").Status,
                        Status.InvalidArgument, "status");
            Check.Throws<ArgumentException>(() => queries.Schedule(positions, few), "two heights for three positions");
            Check.Throws<ArgumentNullException>(() => new OceanQueries(null), "no ocean");
        }
    }

    // Jobs that wait for another job, while their ocean is disposed.
    [Test]
    public static void AnOceanLivesUntilItsQueriesAreDisposed()
    {
        using (var positions = Positions(Count))
        using (var heights = new NativeArray<float>(Count, Allocator.Persistent))
        using (var begin = new ManualResetEvent(false))
        {
            var ocean = new Ocean(Sea.Preset("storm"), new OceanOptions { Queries = true });
            var queries = new OceanQueries(ocean);
            GoldenTests.FrameAt(ocean, 12.34);
            queries.Schedule(positions, heights, dependsOn: new JobHandle { Work = System.Threading.Tasks.Task.Run(() => begin.WaitOne()) });
            var last = positions[Count - 1];
            var expected = ocean.HeightAt(last.x, -last.z);
            ocean.Dispose();
            begin.Set();
            queries.Dispose();
            Check.Equal(heights[Count - 1], expected, "the last height");
            Check.Throws<ObjectDisposedException>(() => queries.Schedule(positions, heights), "disposed queries");
        }
    }

    [Test]
    public static void TheSamplePlacesObjectsOnTheWater()
    {
        var behaviour = new OceanBehaviour { Preset = "storm", Resolution = 32 };
        var buoys = new Buoys { Ocean = behaviour, Objects = new[] { new Transform(), new Transform { position = new Vector3(20, 9, -30) } } };
        BehaviourTests.Send(behaviour, "OnEnable");
        BehaviourTests.Send(buoys, "OnEnable");
        BehaviourTests.Send(behaviour, "Update");
        BehaviourTests.Send(buoys, "LateUpdate");
        foreach (var buoy in buoys.Objects)
        {
            Check.Equal(buoy.position.y, behaviour.HeightAt(buoy.position), "height of a buoy");
            Check.True(buoy.up.y > 0.5f && buoy.up.y < 1, "it is inclined");
        }
        BehaviourTests.Send(buoys, "OnDisable");
        BehaviourTests.Send(behaviour, "OnDisable");
    }
}
