using System;
using System.Threading;
using Pelagic;

public static class ReloadTests
{
    private static ThreadJobs jobs;
    private static Ocean abandoned;

    /// <summary>Leaves a frame in flight, whose jobs run on managed threads and take time.</summary>
    private static void LeaveAFrameInFlight()
    {
        jobs = new ThreadJobs(2) { BeforeJob = () => Thread.Sleep(5) };
        abandoned = new Ocean(Sea.Default, new OceanOptions { Executor = new Executor(jobs, 3) });
        abandoned.Schedule(1);
        while (Volatile.Read(ref jobs.JobCount) == 0) Thread.Yield();
    }

    [Test]
    public static void ADomainWithAFrameInFlightUnloads()
    {
        for (var round = 0; round < 3; ++round)
        {
            var domain = AppDomain.CreateDomain("scripts", null, AppDomain.CurrentDomain.SetupInformation);
            domain.DoCallBack(LeaveAFrameInFlight);
            Exception failure = null;
            var unload = new Thread(() =>
            {
                try
                {
                    AppDomain.Unload(domain);
                }
                catch (Exception exception)
                {
                    failure = exception;
                }
            }) { IsBackground = true };
            unload.Start();
            // A frame takes a second. Without a guard the unload never ends.
            Check.True(unload.Join(60000), "the domain unloads");
            Check.True(failure == null, $"the domain unloads without {failure}");
        }
    }

    [Test]
    public static void DisposeAllDisposesEveryObject()
    {
        LeaveAFrameInFlight();
        PelagicLibrary.DisposeAll();
        Check.Throws<ObjectDisposedException>(() => abandoned.Complete(), "the ocean");
        jobs.Dispose();
    }

    /// <summary>The driver checks that the process ends.</summary>
    [Test]
    public static void AProcessWithAFrameInFlightEnds()
    {
        LeaveAFrameInFlight();
    }
}
