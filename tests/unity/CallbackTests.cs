using System;
using System.Threading;
using Pelagic;

public static class CallbackTests
{
    private sealed class Broken : Exception
    {
    }

    /// <summary>A job system that throws if it is told to.</summary>
    private sealed class BreakingJobs : JobSystem
    {
        public bool BreaksBefore, BreaksAfter, BreaksSubmit;

        public override void ParallelFor(JobBatch batch)
        {
            if (BreaksBefore) throw new Broken();
            for (var i = 0; i < batch.Count; ++i) batch.Run(i);
            if (BreaksAfter) throw new Broken();
        }

        public override bool Submit(JobTask task)
        {
            if (BreaksSubmit) throw new Broken();
            return false;
        }
    }

    [Test]
    public static void AnExceptionOfAJobSystemIsTheInnerExceptionOfComplete()
    {
        var jobs = new BreakingJobs();
        using (var executor = new Executor(jobs, 2))
        using (var ocean = new Ocean(Sea.Default, new OceanOptions { Executor = executor }))
        {
            Action[] breaks = { () => jobs.BreaksBefore = true, () => jobs.BreaksAfter = true, () => jobs.BreaksSubmit = true };
            foreach (var begin in breaks)
            {
                begin();
                ocean.Schedule(0);
                var failure = Check.Throws<PelagicException>(() => ocean.Complete(), "Complete() with a broken job system");
                Check.Equal(failure.Status, Status.ApplicationError, "status");
                Check.True(failure.InnerException is Broken, "the inner exception is that of the callback");
                jobs.BreaksBefore = jobs.BreaksAfter = jobs.BreaksSubmit = false;
                GoldenTests.FrameAt(ocean, 12.34);
                Check.Equal(ocean.Hash(), Expected.Hash("golden default@12.34"), "the next frame");
            }
        }
    }

    [Test]
    public static void AnExceptionOfAWaveInputIsTheInnerExceptionOfComplete()
    {
        var isBroken = true;
        using (var input = WaveInput.Callback(rows =>
        {
            if (isBroken && rows.FirstRow > 0) throw new Broken();
        }, 0))
        using (var ocean = new Ocean(Sea.Default, new OceanOptions { Inputs = new[] { input } }))
        {
            ocean.Schedule(0);
            var failure = Check.Throws<PelagicException>(() => ocean.Complete(), "Complete() with a broken input");
            Check.Equal(failure.Status, Status.ApplicationError, "status");
            Check.True(failure.InnerException is Broken, "the inner exception is that of the callback");
            isBroken = false;
            GoldenTests.FrameAt(ocean, 12.34);
            Check.Equal(ocean.Hash(), Expected.Hash("golden default@12.34"), "the next frame, whose input adds nothing");
        }
    }

    [Test]
    public static void AWaveInputAddsWhatItWrites()
    {
        using (var input = WaveInput.Callback(rows =>
        {
            rows.Height.Fill(3);
            Check.Equal(rows.Height.Length, rows.Resolution * rows.RowCount, "texels of the rows");
        }, 1, 1))
        using (var with = new Ocean(Sea.Default, new OceanOptions { Inputs = new[] { input } }))
        using (var without = new Ocean(Sea.Default))
        {
            Plane raised = GoldenTests.FrameAt(with, 2).Cascade(0).Height, plain = GoldenTests.FrameAt(without, 2).Cascade(0).Height;
            // Within a rounding of heights of a few metres.
            for (var i = 0; i < raised.Resolution; ++i) Check.True(Math.Abs(raised[i, 5] - plain[i, 5] - 3) < 1e-6, "3 m more");
        }
    }

    /// <summary>The driver checks that the process ends: Mono waits for threads that ran callbacks.</summary>
    [Test]
    public static void AProcessWhoseCallbacksRanOnThreadsEnds()
    {
        using (var main = new ThreadLocal<bool> { Value = true })
        using (var explicitDefault = new Executor(new ExecutorOptions()))
        {
            foreach (var executor in new[] { null, explicitDefault })
            {
                var others = 0;
                var waits = Environment.ProcessorCount > 1;
                using (var input = WaveInput.Callback(rows =>
                {
                    if (!main.Value) Interlocked.Increment(ref others);
                    if (!main.Value || !waits) return;
                    SpinWait.SpinUntil(() => Volatile.Read(ref others) > 0, 10000);
                    waits = false;
                }, 0))
                using (var ocean = new Ocean(Sea.Default, new OceanOptions { Inputs = new[] { input }, Executor = executor }))
                {
                    GoldenTests.FrameAt(ocean, 1);
                    Check.Equal(ocean.Info.Executor, "thread", "the default executor");
                    Check.True(others > 0 || Environment.ProcessorCount == 1, "callbacks ran on other threads");
                }
            }
        }
    }

    [Test]
    public static void OneTbbDoesNotRunCallbacks()
    {
        Executor executor;
        try
        {
            executor = new Executor(new ExecutorOptions { Kind = ExecutorKind.Tbb });
        }
        catch (PelagicException)
        {
            return;  // a library without oneTBB
        }
        using (executor)
        using (var input = WaveInput.Callback(rows => { }, 0))
        {
            Check.Throws<ArgumentException>(() => new Ocean(Sea.Default, new OceanOptions { Inputs = new[] { input }, Executor = executor }), "a callback");
            using (var ocean = new Ocean(Sea.Default, new OceanOptions { Executor = executor }))
            {
                GoldenTests.FrameAt(ocean, 12.34);
                Check.Equal(ocean.Hash(), Expected.Hash("golden default@12.34"), "an ocean without callbacks");
            }
        }
    }

    [Test]
    public static void AnInputMayBeDisposedBeforeItsOcean()
    {
        var calls = 0;
        var input = WaveInput.Callback(rows => Interlocked.Increment(ref calls), 0);
        var jobs = new ThreadJobs(2);
        var executor = new Executor(jobs, 2);
        using (var ocean = new Ocean(Sea.Default, new OceanOptions { Inputs = new[] { input }, Executor = executor }))
        {
            input.Dispose();
            executor.Dispose();
            GC.Collect();
            GC.WaitForPendingFinalizers();
            GoldenTests.FrameAt(ocean, 12.34);
            Check.Equal(ocean.Hash(), Expected.Hash("golden default@12.34"), "a frame");
            Check.True(calls > 0 && jobs.JobCount > 0, "the callbacks were called");
        }
        jobs.Dispose();
    }
}
