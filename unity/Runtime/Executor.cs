using System;
using System.Runtime.InteropServices;

namespace Pelagic
{
    /// <summary>A job system of the application, on whose threads oceans compute their frames.</summary>
    public abstract class JobSystem
    {
        /// <summary>
        /// Runs each job of the batch once, on any threads, and returns when all have ended. Jobs need 512 KiB
        /// of stack, 1 MiB for N = 2048. The next Complete() throws what this method throws, as the inner
        /// exception.
        /// </summary>
        public abstract void ParallelFor(JobBatch batch);

        /// <summary>
        /// Schedules the task on another thread, once, and returns immediately. False: the job system has no such
        /// threads, and work begins in Complete().
        /// </summary>
        public virtual bool Submit(JobTask task)
        {
            return false;
        }
    }

    /// <summary>Jobs that may run concurrently. Valid until ParallelFor() returns.</summary>
    public readonly unsafe struct JobBatch
    {
        private readonly Native.pelagic_parallel_for_job run;
        private readonly void* work;

        /// <summary>Number of jobs.</summary>
        public readonly int Count;

        internal JobBatch(IntPtr job, void* work, UIntPtr count)
        {
            run = NativeFunctions<Native.pelagic_parallel_for_job>.At(job);
            this.work = work;
            Count = checked((int)count);
        }

        /// <summary>Runs the job of an index in [0, Count).</summary>
        public void Run(int index)
        {
            if ((uint)index >= (uint)Count) throw new ArgumentOutOfRangeException(nameof(index));
            run(work, (UIntPtr)index);
        }
    }

    /// <summary>A task, which may run late, even after its ocean was disposed.</summary>
    public readonly unsafe struct JobTask
    {
        private readonly Native.pelagic_submit_task run;
        private readonly void* work;

        internal JobTask(IntPtr task, void* work)
        {
            run = NativeFunctions<Native.pelagic_submit_task>.At(task);
            this.work = work;
        }

        public void Run()
        {
            run(work);
        }
    }

    /// <summary>Delegates of functions of the library, each made once: a frame allocates none.</summary>
    internal static class NativeFunctions<T> where T : class
    {
        private struct Entry
        {
            internal IntPtr Pointer;
            internal T Function;
        }

        private static volatile Entry[] entries = new Entry[0];
        private static readonly object adding = new object();

        internal static T At(IntPtr pointer)
        {
            return Find(pointer) ?? Add(pointer);
        }

        private static T Find(IntPtr pointer)
        {
            var all = entries;
            for (var i = 0; i < all.Length; ++i)
                if (all[i].Pointer == pointer) return all[i].Function;
            return null;
        }

        private static T Add(IntPtr pointer)
        {
            lock (adding)
            {
                var function = Find(pointer);
                if (function != null) return function;
                function = (T)(object)Marshal.GetDelegateForFunctionPointer(pointer, typeof(T));
                var all = new Entry[entries.Length + 1];
                entries.CopyTo(all, 0);
                all[entries.Length] = new Entry { Pointer = pointer, Function = function };
                entries = all;
                return function;
            }
        }
    }

    public sealed unsafe partial class ExecutorOptions
    {
        /// <summary>Required by ExecutorKind.Application.</summary>
        public JobSystem Jobs;

        internal void Write(ref Native.pelagic_executor_options native)
        {
            native.struct_size = (uint)sizeof(Native.pelagic_executor_options);
            CopyTo(ref native);
            // At its end Mono waits for threads that ran managed callbacks, and those of oneTBB never end.
            if (Kind == ExecutorKind.Default) native.kind = ExecutorKind.Threads;
        }
    }

    /// <summary>
    /// Threads that compute frames, for one ocean or several. Oceans keep what they need of it, so it may be
    /// disposed before them.
    /// </summary>
    public sealed unsafe class Executor : IDisposable
    {
        private static readonly Native.pelagic_parallel_for parallelFor = OnParallelFor;
        private static readonly Native.pelagic_submit submit = OnSubmit;

        internal readonly ExecutorHandle Handle;
        internal readonly CallbackRoot Root;
        internal readonly ExecutorKind Kind;

        /// <summary>ExecutorKind.Default is ExecutorKind.Threads, whether or not the library has oneTBB.</summary>
        public Executor(ExecutorOptions options)
        {
            if (options == null) throw new ArgumentNullException(nameof(options));
            Kind = options.Kind;
            var native = default(Native.pelagic_executor_options);
            options.Write(ref native);
            Root = options.Jobs == null ? null : new CallbackRoot(options.Jobs);
            if (Root != null)
            {
                native.parallel_for = Marshal.GetFunctionPointerForDelegate(parallelFor);
                native.submit = Marshal.GetFunctionPointerForDelegate(submit);
                native.user = (void*)Root.Pointer;
            }
            IntPtr executor;
            var status = Native.pelagic_executor_create(&native, &executor);
            if (status != Status.Ok)
            {
                Root?.Release();
                throw Errors.Of(status);
            }
            Handle = new ExecutorHandle(executor, Root == null ? new CallbackRoot[0] : new[] { Root });
        }

        /// <summary>Executor of a job system of the application.</summary>
        public Executor(JobSystem jobs, int threads)
            : this(new ExecutorOptions { Kind = ExecutorKind.Application, Threads = threads, Jobs = jobs })
        {
        }

        /// <summary>Sets how long threads look for work before they sleep, in microseconds; [0, 1000].</summary>
        public void SetSpinUs(int us)
        {
            using (var use = new Use(Handle)) Errors.Check(Native.pelagic_executor_set_spin_us(use.Pointer, us));
        }

        public void Dispose()
        {
            Handle.Dispose();
        }

        [MonoPInvokeCallback(typeof(Native.pelagic_parallel_for))]
        private static void OnParallelFor(void* user, UIntPtr count, IntPtr job, void* work)
        {
            var root = CallbackRoot.At(user);
            try
            {
                ((JobSystem)root.Target).ParallelFor(new JobBatch(job, work, count));
            }
            catch (Exception exception)
            {
                root.Record(exception);  // the library runs the jobs that are left, and Complete() fails
            }
        }

        [MonoPInvokeCallback(typeof(Native.pelagic_submit))]
        private static void OnSubmit(void* user, IntPtr task, void* work)
        {
            var root = CallbackRoot.At(user);
            try
            {
                ((JobSystem)root.Target).Submit(new JobTask(task, work));
            }
            catch (Exception exception)
            {
                root.Record(exception);  // Complete() does the work
            }
        }
    }
}
