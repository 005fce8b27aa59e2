using System;
using Pelagic;

public static class AllocationTests
{
    public static object Kept;

    /// <summary>Bytes that 1,000 frames allocate, and the number of collections.</summary>
    private static long Allocated(Ocean ocean, Action perFrame, out int collections)
    {
        double[] x = new double[16], z = new double[16];
        var height = new float[16];
        for (var i = 0; i < 16; ++i) x[i] = 37.5 * i;
        var sum = 0f;
        long bytes = 0;
        collections = 0;
        for (var i = 0; i < 1010; ++i)
        {
            if (i == 10)
            {
                bytes = GC.GetAllocatedBytesForCurrentThread();
                collections = GC.CollectionCount(0);
            }
            ocean.Schedule(i / 90.0);
            var frame = ocean.Complete();
            ocean.Query(x, z, new Samples { HeightM = height });
            sum += ocean.HeightAt(i, 3);
            for (var c = 0; c < frame.CascadeCount; ++c)
            {
                var cascade = frame.Cascade(c);
                sum += cascade.SlopesRgba8[cascade.LevelOffset(1)] + cascade.Height[1, 2] + cascade.DisplacementRgba16f[5];
            }
            if (ocean.IsReady) perFrame();
        }
        Check.True(!float.IsNaN(sum), "sums are numbers");
        collections = GC.CollectionCount(0) - collections;
        return GC.GetAllocatedBytesForCurrentThread() - bytes;
    }

    [Test]
    public static void AThousandFramesAllocateNothing()
    {
        foreach (var kind in new[] { ExecutorKind.Serial, ExecutorKind.Threads })
        {
            var sea = Sea.Default;
            sea.Resolution = 32;
            using (var executor = new Executor(new ExecutorOptions { Kind = kind, Threads = 2 }))
            using (var ocean = new Ocean(sea, new OceanOptions { Queries = true, Executor = executor }))
            {
                var bytes = Allocated(ocean, () => { }, out var collections);
                Check.Equal(bytes, 0L, $"bytes of {kind}");
                Check.Equal(collections, 0, $"collections of {kind}");
            }
        }
    }

    // The test above would find a small object a frame.
    [Test]
    public static void AnObjectAFrameIsCounted()
    {
        var sea = Sea.Default;
        sea.Resolution = 16;
        sea.Cascades = 1;
        using (var executor = new Executor(new ExecutorOptions { Kind = ExecutorKind.Serial }))
        using (var ocean = new Ocean(sea, new OceanOptions { Queries = true, Executor = executor, Slopes = Textures.On }))
            Check.True(Allocated(ocean, () => Kept = new object(), out _) > 8000, "1,000 objects are counted");
    }
}
