using System;
using System.Runtime.CompilerServices;
using System.Threading;
using Pelagic;

public static class LifetimeTests
{
    [Test]
    public static void AnInvalidSeaIsNamedInTheException()
    {
        var sea = Sea.Default;
        sea.WindSpeedMps = -3;
        foreach (var action in new Action[] { () => new Ocean(sea), () => sea.Check(), () => sea.Statistics() })
        {
            var failure = Check.Throws<PelagicException>(action, "an invalid sea");
            Check.Equal(failure.Status, Status.InvalidArgument, "status");
            Check.Equal(failure.Message, "wind_speed_mps -3 is out of range (0, 60]", "message");
        }
        Check.Throws<PelagicException>(() => default(Sea).Check(), "a sea of zeros");
        Check.True(Sea.Preset("storm").Statistics().ExpectedWaveHeightM > 3, "waves of a storm");
        Check.Throws<PelagicException>(() => Sea.Preset("stormy"), "an unknown preset");
    }

    [Test]
    public static void ASeaHasAtMostEightSystems()
    {
        var sea = Sea.Default;
        Check.Equal(sea.Systems.Length, 0, "no system by default");
        var swell = WaveSystem.Default;
        swell.HeightM = 2;
        sea.Systems = new[] { WaveSystem.Default, swell };
        Check.Equal(sea.Systems.Length, 2, "two systems");
        Check.Equal(sea.Systems[1].HeightM, 2.0, "height of the second");
        swell.HeightM = -1;
        sea.Systems = new[] { WaveSystem.Default, swell };
        Check.Equal(Check.Throws<PelagicException>(() => sea.Check(), "a negative height").Message, "systems[1].height_m -1 is out of range (0, 30], or 0: by the wind", "message");
        Check.Equal(Check.Throws<ArgumentException>(() => sea.Systems = new WaveSystem[9], "nine systems").Message, "Systems has 9 elements, expected 0 to 8", "message");
    }

    [Test]
    public static void CallsInTheWrongOrderThrow()
    {
        using (var ocean = new Ocean(Sea.Default))
        {
            Check.Equal(Check.Throws<PelagicException>(() => ocean.Complete(), "no frame").Status, Status.WrongOrder, "status");
            ocean.Schedule(0);
            Check.Equal(Check.Throws<PelagicException>(() => ocean.Schedule(1), "two frames").Status, Status.WrongOrder, "status");
            Check.Throws<PelagicException>(() => ocean.HeightAt(0, 0), "a query without the option");
            Check.Throws<PelagicException>(() => ocean.FoamHash(), "foam without the option");
            var frame = ocean.Complete();
            Check.Throws<InvalidOperationException>(() => frame.Shoreline.ToString(), "no shore");
            Check.Throws<InvalidOperationException>(() => frame.DynamicWaves.ToString(), "no dynamic waves");
            Check.Throws<ArgumentOutOfRangeException>(() => frame.Cascade(4), "a fifth cascade");
            Check.True(frame.Cascade(0).CompressionR8.IsEmpty && frame.Cascade(0).VelocityX.IsEmpty, "what the ocean was made without is empty");
            Check.Throws<InvalidOperationException>(() => default(Frame).TimeS.ToString(), "no frame");
        }
    }

    [Test]
    public static void AFrameEndsAtTheSecondSchedule()
    {
        using (var ocean = new Ocean(Sea.Default))
        {
            var first = GoldenTests.FrameAt(ocean, 1);
            var cascade = first.Cascade(2);
            var height = cascade.Height;
            var texel = height[3, 4];
            ocean.Schedule(2);
            Check.Equal(first.TimeS, 1.0, "the first frame, during the second");
            var second = ocean.Complete();
            Check.Equal(height[3, 4], texel, "a texel after the second frame");
            ocean.Schedule(3);
            Check.Throws<InvalidOperationException>(() => first.TimeS.ToString(), "the frame");
            Check.Throws<InvalidOperationException>(() => cascade.SlopesRgba8.ToArray(), "its cascade");
            Check.Throws<InvalidOperationException>(() => height.Data.ToArray(), "its plane");
            Check.Throws<InvalidOperationException>(() => height[0, 0].ToString(), "its texels");
            Check.Equal(second.TimeS, 2.0, "the second frame");
            ocean.Complete();
            Check.Equal(second.TimeS, 2.0, "the second frame");
            ocean.Schedule(4);
            Check.Throws<InvalidOperationException>(() => second.TimeS.ToString(), "the second frame");
        }
    }

    [Test]
    public static void DynamicWavesOfAnOceanAreInItsFrames()
    {
        var options = DynamicWavesOptions.Default;
        options.Resolution = 64;
        var ocean = new Ocean(Sea.Default, new OceanOptions { DynamicWaves = options });
        var stone = Disturbance.Default;
        stone.Mode = DisturbanceKind.Impulse;
        stone.HeightM = 0.5;
        GoldenTests.FrameAt(ocean, 0);
        ocean.DynamicWaves.AddImpulse(stone);
        var view = GoldenTests.FrameAt(ocean, 0.1).DynamicWaves;
        Check.True(view.HeightMaxM > 0.05 && view.HeightM.Length == 64 * 64, "the stone makes waves");
        Check.Throws<InvalidOperationException>(() => ocean.DynamicWaves.View.ToString(), "a view without a frame");
        Check.Throws<PelagicException>(() => ocean.DynamicWaves.Advance(1), "Advance() of an ocean's waves");
        ocean.Dispose();
        Check.Throws<ObjectDisposedException>(() => ocean.DynamicWaves.AddImpulse(stone), "waves of a disposed ocean");
        Check.Throws<ObjectDisposedException>(() => view.HeightM.ToArray(), "a view of a disposed ocean");
    }

    [Test]
    public static void ADisposedObjectThrows()
    {
        var ocean = new Ocean(Sea.Default, new OceanOptions { Queries = true });
        var frame = GoldenTests.FrameAt(ocean, 0);
        ocean.Schedule(1);
        ocean.Dispose();
        ocean.Dispose();
        Action[] uses =
        {
            () => ocean.Schedule(0), () => ocean.Complete(), () => ocean.HeightAt(0, 0), () => ocean.Hash(), () => ocean.Info.ToString(),
            () => ocean.ScheduleSea(Sea.Default), () => frame.TimeS.ToString(), () => frame.Cascade(0).ToString(),
        };
        foreach (var use in uses) Check.Throws<ObjectDisposedException>(use, "a disposed ocean");
        var executor = new Executor(new ExecutorOptions { Kind = ExecutorKind.Serial });
        executor.Dispose();
        Check.Throws<ObjectDisposedException>(() => executor.SetSpinUs(0), "a disposed executor");
        Check.Throws<ObjectDisposedException>(() => new Ocean(Sea.Default, new OceanOptions { Executor = executor }), "an ocean of a disposed executor");
    }

    [Test]
    public static void AnOceanMayBeDisposedWhileThreadsQueryIt()
    {
        for (var round = 0; round < 5; ++round)
        {
            var ocean = new Ocean(Sea.Default, new OceanOptions { Queries = true });
            GoldenTests.FrameAt(ocean, 0);
            var threads = new Thread[3];
            var queries = 0;
            Exception wrong = null;
            for (var i = 0; i < threads.Length; ++i)
            {
                threads[i] = new Thread(() =>
                {
                    try
                    {
                        for (;; Interlocked.Increment(ref queries)) ocean.HeightAt(queries, 1);
                    }
                    catch (ObjectDisposedException)
                    {
                    }
                    catch (Exception exception)
                    {
                        wrong = exception;
                    }
                });
                threads[i].Start();
            }
            while (Volatile.Read(ref queries) < 100) Thread.Yield();
            ocean.Dispose();
            foreach (var thread in threads) thread.Join();
            Check.True(wrong == null, $"queries end with ObjectDisposedException, not {wrong}");
        }
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private static WeakReference[] Abandon(int count)
    {
        var sea = Sea.Default;
        sea.Resolution = 32;
        var jobs = new WeakReference[count];
        for (var i = 0; i < count; ++i)
        {
            var system = new ThreadJobs(0);
            jobs[i] = new WeakReference(system);
            var ocean = new Ocean(sea, new OceanOptions { Executor = new Executor(system, 2) });
            ocean.Schedule(i);
        }
        return jobs;
    }

    [Test]
    public static void AbandonedOceansAreCollectedWithTheirCallbacks()
    {
        WeakReference[] jobs = null;
        // On a thread of its own: the collector scans stacks conservatively.
        var thread = new Thread(() => jobs = Abandon(20));
        thread.Start();
        thread.Join();
        for (var i = 0; i < 5; ++i)
        {
            GC.Collect();
            GC.WaitForPendingFinalizers();
        }
        var alive = Array.FindAll(jobs, job => job.IsAlive).Length;
        Check.True(alive <= 2, $"{alive} of 20 job systems are alive");
    }

    [Test]
    public static void AnotherSeaAndAForecastReplaceTheFirst()
    {
        Sea calm = Sea.Preset("calm"), storm = Sea.Preset("storm");
        using (var ocean = new Ocean(calm))
        {
            ocean.ScheduleSea(storm);
            ocean.CompleteSea();
            GoldenTests.FrameAt(ocean, 12.34);
            Check.Equal(ocean.Hash(), Expected.Hash("golden preset-storm@12.34"), "the storm");
        }
        storm.Resolution = calm.Resolution;
        storm.LoopPeriodS = calm.LoopPeriodS;
        storm.DepthM = calm.DepthM;
        using (var ocean = new Ocean(calm, new[] { new Change { Sea = storm, FromS = 10, OverS = 20 } }))
        {
            var before = GoldenTests.FrameAt(ocean, 0).Bounds.HeightMaxM;
            ocean.ScheduleChange(new Change { Sea = calm, FromS = 100, OverS = 20 });
            var during = GoldenTests.FrameAt(ocean, 50).Bounds.HeightMaxM;
            var after = GoldenTests.FrameAt(ocean, 200).Bounds.HeightMaxM;
            Check.True(during > 3 * before && after < during / 3, $"heights of {before}, {during} and {after} m");
        }
    }

    [Test]
    public static void AnOceanDescribesItself()
    {
        using (var executor = new Executor(new ExecutorOptions { Kind = ExecutorKind.Serial }))
        using (var ocean = new Ocean(Sea.Default, new OceanOptions { Executor = executor, Isa = "sse4.2" }))
        {
            var info = ocean.Info;
            Check.Equal(info.Isa, "sse4.2", "isa");
            Check.Equal(info.Executor, "serial", "executor");
            Check.Equal(info.CascadeCount, 4, "cascades");
            Check.True(info.MemoryBytes > 1000000 && info.Threads == 1 && info.Resolution == 128, "memory, threads and resolution");
        }
        Check.True(PelagicLibrary.Version >= new Version(0, 1, 0), "version");
    }
}
