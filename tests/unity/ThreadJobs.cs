using System;
using System.Collections.Generic;
using System.Threading;
using Pelagic;

/// <summary>A job system of managed threads.</summary>
public sealed class ThreadJobs : JobSystem, IDisposable
{
    public int JobCount;
    /// <summary>Called before each job, on its thread.</summary>
    public Action BeforeJob = () => { };
    private readonly Queue<Action> queue = new Queue<Action>();
    private bool isOver;

    public ThreadJobs(int threads)
    {
        for (var i = 0; i < threads; ++i) new Thread(Work) { IsBackground = true }.Start();
    }

    public override void ParallelFor(JobBatch batch)
    {
        int next = 0, left = batch.Count;
        Exception failure = null;
        using (var done = new ManualResetEvent(batch.Count == 0))
        {
            Action work = () =>
            {
                for (int i; (i = Interlocked.Increment(ref next) - 1) < batch.Count;)
                {
                    try
                    {
                        BeforeJob();
                        batch.Run(i);
                    }
                    catch (Exception exception)
                    {
                        failure = exception;
                    }
                    Interlocked.Increment(ref JobCount);
                    if (Interlocked.Decrement(ref left) == 0) done.Set();
                }
            };
            Add(work);
            Add(work);
            work();
            done.WaitOne();
        }
        if (failure != null) throw failure;
    }

    public override bool Submit(JobTask task)
    {
        Add(() => task.Run());
        return true;
    }

    public void Dispose()
    {
        lock (queue)
        {
            isOver = true;
            Monitor.PulseAll(queue);
        }
    }

    private void Add(Action work)
    {
        lock (queue)
        {
            queue.Enqueue(work);
            Monitor.Pulse(queue);
        }
    }

    private void Work()
    {
        for (;;)
        {
            Action work;
            lock (queue)
            {
                while (queue.Count == 0 && !isOver) Monitor.Wait(queue);
                if (queue.Count == 0) return;
                work = queue.Dequeue();
            }
            work();
        }
    }
}
