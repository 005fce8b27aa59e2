using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Threading;

namespace Pelagic
{
    /// <summary>
    /// Keeps the target of callbacks alive as long as the objects of the library that call it, and holds the
    /// first exception that a callback threw.
    /// </summary>
    internal sealed class CallbackRoot
    {
        internal readonly object Target;
        private GCHandle self;
        private int users = 1;
        private Exception failure;

        internal CallbackRoot(object target)
        {
            Target = target;
            self = GCHandle.Alloc(this);
        }

        internal IntPtr Pointer => GCHandle.ToIntPtr(self);

        internal static unsafe CallbackRoot At(void* pointer)
        {
            return (CallbackRoot)GCHandle.FromIntPtr((IntPtr)pointer).Target;
        }

        internal void Add()
        {
            Interlocked.Increment(ref users);
        }

        internal void Release()
        {
            if (Interlocked.Decrement(ref users) == 0) self.Free();
        }

        internal void Record(Exception exception)
        {
            Interlocked.CompareExchange(ref failure, exception, null);
        }

        internal Exception TakeFailure()
        {
            return failure == null ? null : Interlocked.Exchange(ref failure, null);
        }
    }

    /// <summary>A handle of the library and the callbacks that it may call.</summary>
    internal abstract class NativeHandle : SafeHandle
    {
        private readonly CallbackRoot[] roots;

        protected NativeHandle(IntPtr pointer, CallbackRoot[] roots) : base(IntPtr.Zero, true)
        {
            this.roots = roots;
            SetHandle(pointer);
            LiveHandles.Add(this);
        }

        public override bool IsInvalid => handle == IntPtr.Zero;

        protected abstract void Destroy();

        protected override bool ReleaseHandle()
        {
            Destroy();
            foreach (var root in roots) root.Release();
            return true;
        }
    }

    internal sealed class OceanHandle : NativeHandle
    {
        internal OceanHandle(IntPtr pointer, CallbackRoot[] roots) : base(pointer, roots) { }
        protected override void Destroy() => Native.pelagic_ocean_destroy(handle);
    }

    internal sealed class ExecutorHandle : NativeHandle
    {
        internal ExecutorHandle(IntPtr pointer, CallbackRoot[] roots) : base(pointer, roots) { }
        protected override void Destroy() => Native.pelagic_executor_destroy(handle);
    }

    internal sealed class ExactWaterHandle : NativeHandle
    {
        internal ExactWaterHandle(IntPtr pointer, CallbackRoot[] roots) : base(pointer, roots) { }
        protected override void Destroy() => Native.pelagic_exact_water_destroy(handle);
    }

    internal sealed class DynamicWavesHandle : NativeHandle
    {
        internal DynamicWavesHandle(IntPtr pointer, CallbackRoot[] roots) : base(pointer, roots) { }
        protected override void Destroy() => Native.pelagic_dynamic_waves_destroy(handle);
    }

    internal sealed class InputHandle : NativeHandle
    {
        internal InputHandle(IntPtr pointer, CallbackRoot[] roots) : base(pointer, roots) { }
        protected override void Destroy() => Native.pelagic_input_destroy(handle);
    }

    internal sealed class HullHandle : NativeHandle
    {
        internal HullHandle(IntPtr pointer, CallbackRoot[] roots) : base(pointer, roots) { }
        protected override void Destroy() => Native.pelagic_hull_destroy(handle);
    }

    internal sealed class BodiesHandle : NativeHandle
    {
        internal BodiesHandle(IntPtr pointer, CallbackRoot[] roots) : base(pointer, roots) { }
        protected override void Destroy() => Native.pelagic_bodies_destroy(handle);
    }

    /// <summary>
    /// Holds a handle during a call, so that Dispose on another thread releases it afterwards. Throws
    /// ObjectDisposedException for a released handle. A null handle has a null pointer.
    /// </summary>
    internal readonly struct Use : IDisposable
    {
        private readonly SafeHandle held;
        internal readonly IntPtr Pointer;

        internal Use(SafeHandle handle)
        {
            var added = false;
            handle?.DangerousAddRef(ref added);
            held = handle;
            Pointer = handle == null ? IntPtr.Zero : handle.DangerousGetHandle();
        }

        public void Dispose()
        {
            held?.DangerousRelease();
        }
    }

    /// <summary>
    /// The handles of this application domain. Before the domain is unloaded, oceans are destroyed while
    /// threads still run: an ocean waits for its callbacks, and those would wait for threads that have ended.
    /// </summary>
    internal static class LiveHandles
    {
        // Weak, but up to the end of finalizers, which run during the unload.
        private static readonly List<WeakReference> handles = new List<WeakReference>();

        static LiveHandles()
        {
            AppDomain.CurrentDomain.DomainUnload += (sender, arguments) => DisposeAll();
            AppDomain.CurrentDomain.ProcessExit += (sender, arguments) => DisposeAll();
        }

        internal static void Add(SafeHandle handle)
        {
            lock (handles)
            {
                handles.RemoveAll(entry => !(entry.Target is SafeHandle other) || other.IsClosed);
                handles.Add(new WeakReference(handle, true));
            }
        }

        internal static void DisposeAll()
        {
            WeakReference[] all;
            lock (handles)
            {
                all = handles.ToArray();
                handles.Clear();
            }
            // Later objects use earlier ones.
            for (var i = all.Length - 1; i >= 0; --i) (all[i].Target as SafeHandle)?.Dispose();
        }
    }

    /// <summary>Marks callbacks for ahead-of-time compilers, which find the attribute by its name.</summary>
    [AttributeUsage(AttributeTargets.Method)]
    internal sealed class MonoPInvokeCallbackAttribute : Attribute
    {
        internal MonoPInvokeCallbackAttribute(Type type) { }
    }
}
