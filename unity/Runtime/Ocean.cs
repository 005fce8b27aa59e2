using System;
using System.Collections.Generic;

namespace Pelagic
{
    public sealed partial class OceanOptions
    {
        /// <summary>Null: a thread pool of the ocean.</summary>
        public Executor Executor;
        /// <summary>"sse4.2", "avx2", "avx512" or "neon". Null: the widest that the CPU supports.</summary>
        public string Isa;
        /// <summary>Null: no dynamic waves.</summary>
        public DynamicWavesOptions? DynamicWaves;
        /// <summary>Null: no spray.</summary>
        public SprayOptions? Spray;
        /// <summary>Null: no shore.</summary>
        public ShoreOptions Shore;
        /// <summary>Null: no wave inputs.</summary>
        public WaveInput[] Inputs;

        internal void Write(ref Native.pelagic_ocean_options native)
        {
            CopyTo(ref native);
        }
    }

    /// <summary>A sea at the start of a transition, and its length.</summary>
    public struct Change
    {
        /// <summary>The sea after the transition.</summary>
        public Sea Sea;
        /// <summary>Start; not before the end of the preceding change.</summary>
        public double FromS;
        /// <summary>Duration; (0, 1e9].</summary>
        public double OverS;
        /// <summary>Distance to the origin of the swell; [1e3, 2e7], or 0: all waves change together.</summary>
        public double SwellFromM;
    }

    /// <summary>Properties of an ocean.</summary>
    public readonly struct OceanInfo
    {
        public readonly int Resolution, Threads, CascadeCount;
        public readonly ulong MemoryBytes;
        public readonly string Isa, Executor;

        internal unsafe OceanInfo(in Native.pelagic_ocean_info info)
        {
            Resolution = info.resolution;
            Threads = info.threads;
            CascadeCount = info.cascade_count;
            MemoryBytes = info.memory_bytes;
            Isa = Errors.TextOf(info.isa);
            Executor = Errors.TextOf(info.executor);
        }
    }

    /// <summary>
    /// Computes frames of a sea. One thread at a time calls its methods; queries may run on any thread. Dispose it,
    /// or its memory stays until the garbage collector finds it.
    /// </summary>
    public sealed unsafe partial class Ocean : IDisposable
    {
        private readonly OceanHandle handle;
        private readonly CallbackRoot[] roots;
        private readonly Steps steps;
        private readonly FrameSlot[] slots;
        private readonly IntPtr waves;
        private readonly bool hasShore;
        private (double X, double Z) nextOrigin, scheduledOrigin;
        private WaterFrame nextWater, scheduledWater;
        private readonly List<BodiesHandle> keptBodies = new List<BodiesHandle>();
        private long frames;

        /// <summary>Creates an ocean and computes the spectrum of its sea.</summary>
        public Ocean(Sea sea, OceanOptions options = null) : this(sea, null, 0, options)
        {
        }

        /// <summary>
        /// Creates an ocean with a forecast: a sea and its changes in order of time. largestPeakM: the longest peak
        /// wavelength that later changes may have; 0: that of these seas.
        /// </summary>
        public Ocean(Sea first, Change[] changes, double largestPeakM = 0, OceanOptions options = null)
        {
            options = options ?? new OceanOptions();
            var inputs = options.Inputs ?? new WaveInput[0];
            roots = RootsOf(options.Executor, inputs);
            if (options.Executor?.Kind == ExecutorKind.Tbb && roots.Length > 0)
                throw new ArgumentException("WaveInput.Callback with ExecutorKind.Tbb: Mono would wait for oneTBB's threads at its end; other executors are accepted");
            IntPtr ocean;
            using (var own = options.Executor == null ? new Executor(new ExecutorOptions()) : null)
            using (var executor = new Use((options.Executor ?? own).Handle))
            {
                var used = new Use[inputs.Length];
                var pointers = new IntPtr[inputs.Length];
                try
                {
                    for (var i = 0; i < inputs.Length; ++i)
                    {
                        used[i] = new Use(inputs[i].Handle);
                        pointers[i] = used[i].Pointer;
                    }
                    var status = Create(first, changes, largestPeakM, options, executor.Pointer, pointers, out ocean);
                    if (status != Status.Ok) throw Failure(status);
                }
                finally
                {
                    foreach (var use in used) use.Dispose();
                }
            }
            foreach (var root in roots) root.Add();
            handle = new OceanHandle(ocean, roots);
            steps = new Steps(handle);
            slots = new[] { new FrameSlot(steps), new FrameSlot(steps) };
            hasShore = options.Shore != null;
            if (options.DynamicWaves == null) return;
            IntPtr owned;
            Errors.Check(Native.pelagic_ocean_dynamic_waves(ocean, &owned));
            waves = owned;
            DynamicWaves = new DynamicWaves(handle, owned);
        }

        internal OceanHandle Handle => handle;

        /// <summary>
        /// Keeps the handle of bodies up to the end of the ocean: a finalizer's thread would enqueue commands of their
        /// wakes while another thread uses the ocean.
        /// </summary>
        internal void Keep(BodiesHandle bodies)
        {
            lock (keptBodies) keptBodies.Add(bodies);
        }

        internal void Forget(BodiesHandle bodies)
        {
            lock (keptBodies) keptBodies.Remove(bodies);
        }

        /// <summary>The waves of OceanOptions.DynamicWaves, or null.</summary>
        public DynamicWaves DynamicWaves { get; }

        public OceanInfo Info
        {
            get
            {
                Native.pelagic_ocean_info info;
                using (var use = new Use(handle)) Errors.Check(Native.pelagic_ocean_describe(use.Pointer, &info));
                return new OceanInfo(info);
            }
        }

        /// <summary>Starts a frame and returns immediately. timeS: any finite time, in any order.</summary>
        public void Schedule(double timeS)
        {
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_ocean_schedule(use.Pointer, timeS));
            Scheduled();
        }

        private void Scheduled()
        {
            scheduledOrigin = nextOrigin;
            scheduledWater = nextWater;
            ++steps.Count;
        }

        /// <summary>
        /// Shifts the world's origin to a position of the world as it was before any shift, each in [-1e8, 1e8]. It
        /// counts for frames that are scheduled from now on, for commands of dynamic waves and for spray. A position
        /// in the old coordinates plus the old origin minus the new one is that in the new ones: Bodies.Shift() moves
        /// bodies. Textures, hashes and a shore's place stay.
        /// </summary>
        public void SetOrigin(double xM, double zM)
        {
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_ocean_set_origin(use.Pointer, xM, zM));
            nextOrigin = (xM, zM);
        }

        /// <summary>
        /// Sets the sea level and the current of frames that are scheduled from now on. The current has flowed since
        /// t = 0: to change it moves the sea by the change times t.
        /// </summary>
        public void SetWaterFrame(WaterFrame water)
        {
            water.struct_size = (uint)sizeof(WaterFrame);
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_ocean_set_water_frame(use.Pointer, &water));
            nextWater = water;
        }

        /// <summary>The sea of the frame completed last, which lies between two seas during a change.</summary>
        public Sea Sea
        {
            get
            {
                var sea = default(Sea).Sized();
                using (var use = new Use(handle)) Errors.Check(Native.pelagic_ocean_sea(use.Pointer, &sea));
                return sea;
            }
        }

        /// <summary>True if Complete() would not wait for other threads.</summary>
        public bool IsReady
        {
            get
            {
                int isReady;
                using (var use = new Use(handle)) Errors.Check(Native.pelagic_ocean_poll(use.Pointer, &isReady));
                return isReady != 0;
            }
        }

        /// <summary>
        /// Completes the frame in flight. The calling thread takes part in the work. After an exception that frame
        /// is lost, and another may be scheduled.
        /// </summary>
        public Frame Complete()
        {
            using (var use = new Use(handle))
            {
                var slot = slots[frames & 1];
                fixed (Native.pelagic_frame* frame = &slot.Frame)
                    CheckWithCallbacks(Native.pelagic_ocean_complete(use.Pointer, frame));
                slot.Read(use.Pointer, waves, hasShore);
                slot.Origin = scheduledOrigin;
                slot.Water = scheduledWater;
                slot.Begin(++frames);
                return new Frame(slot);
            }
        }

        /// <summary>64-bit hash of the frame completed last. Equal hashes mean bit-identical seas.</summary>
        public ulong Hash() => HashOf(Pelagic.Hash.Frame);

        /// <summary>64-bit hash of the foam; with OceanOptions.Foam.</summary>
        public ulong FoamHash() => HashOf(Pelagic.Hash.Foam);

        /// <summary>64-bit hash of the shore; with OceanOptions.Shore.</summary>
        public ulong ShoreHash() => HashOf(Pelagic.Hash.Shore);

        private ulong HashOf(Hash kind)
        {
            ulong hash;
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_ocean_frame_hash(use.Pointer, 0, (int)kind, &hash));
            return hash;
        }

        /// <summary>
        /// Starts to compute another sea, of equal resolution and number of cascades. Frames show the current sea
        /// until CompleteSea().
        /// </summary>
        public void ScheduleSea(Sea sea)
        {
            sea = sea.Sized();
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_ocean_schedule_sea(use.Pointer, &sea));
        }

        /// <summary>True if CompleteSea() would not wait for other threads.</summary>
        public bool IsSeaReady
        {
            get
            {
                int isReady;
                using (var use = new Use(handle)) Errors.Check(Native.pelagic_ocean_poll_sea(use.Pointer, &isReady));
                return isReady != 0;
            }
        }

        /// <summary>Makes the new sea current, for frames scheduled from now on.</summary>
        public void CompleteSea()
        {
            using (var use = new Use(handle)) CheckWithCallbacks(Native.pelagic_ocean_complete_sea(use.Pointer));
        }

        /// <summary>
        /// Appends a change to the forecast. From before the frame scheduled last, it starts at that frame's time.
        /// </summary>
        public void ScheduleChange(Change change)
        {
            var sea = change.Sea.Sized();
            var native = ChangeOf(change, &sea);
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_ocean_schedule_change(use.Pointer, &native));
        }

        /// <summary>
        /// Waits for work in flight and destroys the ocean; if other threads are in queries, the last of them
        /// destroys it. Frames are over.
        /// </summary>
        public void Dispose()
        {
            handle.Dispose();
        }

        private static CallbackRoot[] RootsOf(Executor executor, WaveInput[] inputs)
        {
            var roots = new List<CallbackRoot>();
            if (executor?.Root != null) roots.Add(executor.Root);
            foreach (var input in inputs)
                if (input.Root != null) roots.Add(input.Root);
            return roots.ToArray();
        }

        private static Status Create(Sea first, Change[] changes, double largestPeakM, OceanOptions options, IntPtr executor, IntPtr[] inputs, out IntPtr ocean)
        {
            var native = new Native.pelagic_ocean_options { struct_size = (uint)sizeof(Native.pelagic_ocean_options) };
            options.Write(ref native);
            native.executor = executor;
            var waves = options.DynamicWaves.GetValueOrDefault();
            waves.struct_size = (uint)sizeof(DynamicWavesOptions);
            if (options.DynamicWaves != null) native.dynamic_waves = &waves;
            var spray = options.Spray.GetValueOrDefault();
            spray.struct_size = (uint)sizeof(SprayOptions);
            if (options.Spray != null) native.spray = &spray;
            var shore = default(Native.pelagic_shore_options);
            options.Shore?.Write(ref shore);
            var seas = Array.ConvertAll(changes ?? new Change[0], change => change.Sea.Sized());
            var nativeChanges = new Native.pelagic_change[seas.Length];
            first = first.Sized();
            fixed (byte* isa = Errors.BytesOf(options.Isa))
            fixed (IntPtr* firstInput = inputs)
            fixed (float* heights = options.Shore?.HeightsM)
            fixed (Sea* changedSeas = seas)
            fixed (Native.pelagic_change* firstChange = nativeChanges)
            fixed (IntPtr* created = &ocean)
            {
                native.isa = isa;
                native.inputs = firstInput;
                native.input_count = (UIntPtr)inputs.Length;
                shore.heights_m = heights;
                if (options.Shore != null) native.shore = &shore;
                if (changes == null) return Native.pelagic_ocean_create(&first, &native, created);
                for (var i = 0; i < seas.Length; ++i) nativeChanges[i] = ChangeOf(changes[i], changedSeas + i);
                var forecast = new Native.pelagic_forecast
                {
                    struct_size = (uint)sizeof(Native.pelagic_forecast),
                    change_count = (uint)seas.Length,
                    first = &first,
                    changes = firstChange,
                    largest_peak_m = largestPeakM,
                };
                return Native.pelagic_ocean_create_forecast(&forecast, &native, created);
            }
        }

        private static Native.pelagic_change ChangeOf(in Change change, Sea* sea)
        {
            return new Native.pelagic_change
            {
                struct_size = (uint)sizeof(Native.pelagic_change),
                sea = sea,
                from_s = change.FromS,
                over_s = change.OverS,
                swell_from_m = change.SwellFromM,
            };
        }

        private void CheckWithCallbacks(Status status)
        {
            if (status != Status.Ok) throw Failure(status);
            // Callbacks that threw without effect on the frame, for instance after their last job.
            foreach (var root in roots)
                if (root.TakeFailure() is Exception failure)
                    throw new PelagicException(Status.ApplicationError, "A callback threw: " + failure.Message, failure);
        }

        private PelagicException Failure(Status status)
        {
            foreach (var root in roots)
                if (root.TakeFailure() is Exception failure)
                    return new PelagicException(Status.ApplicationError, "A callback threw: " + failure.Message, failure);
            return Errors.Of(status);
        }
    }
}
