using System;
using System.Runtime.InteropServices;

namespace Pelagic
{
    public partial struct DynamicWavesOptions
    {
        /// <summary>The default options: spectral, 256 texels on 64 m, 60 ticks a second.</summary>
        public static DynamicWavesOptions Default => Native.pelagic_dynamic_waves_options_make();
    }

    public partial struct Disturbance
    {
        /// <summary>A pressure of 0 m at the origin, radius and length 1 m, rate 10.</summary>
        public static Disturbance Default => Native.pelagic_disturbance_make();
    }

    public partial struct Rain
    {
        /// <summary>No rain, drops of 0.25 m radius and 0.02 m depth, seed 1.</summary>
        public static Rain Default => Native.pelagic_rain_make();
    }

    /// <summary>
    /// Wakes, ripples and splashes on a grid around a point that the application sets. Commands take effect at the
    /// next Advance(), or the next Schedule() of the ocean that owns the waves. One thread at a time calls methods
    /// of the waves, and of their ocean.
    /// </summary>
    public sealed unsafe class DynamicWaves : IDisposable
    {
        private readonly SafeHandle owner;
        private readonly IntPtr waves;
        private readonly bool isOwned;
        private readonly Steps steps;
        private readonly WavesSlot[] slots;
        private long views;

        private sealed class WavesSlot : Slot
        {
            internal Native.pelagic_dynamic_waves_view View;
            internal long Step = -1;

            internal WavesSlot(Steps steps) : base(steps) { }
        }

        /// <summary>Waves without an ocean. executor: null for the default one.</summary>
        public DynamicWaves(DynamicWavesOptions options, Executor executor = null, string isa = null)
        {
            options.struct_size = (uint)sizeof(DynamicWavesOptions);
            using (var use = new Use(executor?.Handle))
            fixed (byte* name = Errors.BytesOf(isa))
            {
                var resources = new Native.pelagic_dynamic_waves_resources
                {
                    struct_size = (uint)sizeof(Native.pelagic_dynamic_waves_resources),
                    executor = use.Pointer,
                    isa = name,
                };
                IntPtr created;
                Errors.Check(Native.pelagic_dynamic_waves_create(&options, &resources, &created));
                waves = created;
            }
            var roots = executor?.Root == null ? new CallbackRoot[0] : new[] { executor.Root };
            foreach (var root in roots) root.Add();
            owner = new DynamicWavesHandle(waves, roots);
            isOwned = true;
            steps = new Steps(owner);
            slots = new[] { new WavesSlot(steps), new WavesSlot(steps) };
        }

        /// <summary>The waves of an ocean.</summary>
        internal DynamicWaves(OceanHandle ocean, IntPtr waves)
        {
            owner = ocean;
            this.waves = waves;
        }

        /// <summary>Enqueues a disturbance that acts once, in the next tick.</summary>
        public void AddImpulse(Disturbance disturbance)
        {
            disturbance.struct_size = (uint)sizeof(Disturbance);
            using (new Use(owner)) Errors.Check(Native.pelagic_dynamic_waves_add_impulse(waves, &disturbance));
        }

        /// <summary>Adds a source, which acts in every tick. Returns its number.</summary>
        public uint AddSource(Disturbance source)
        {
            source.struct_size = (uint)sizeof(Disturbance);
            uint number;
            using (new Use(owner)) Errors.Check(Native.pelagic_dynamic_waves_add_source(waves, &source, &number));
            return number;
        }

        /// <summary>Replaces a source. Does nothing if no source has that number.</summary>
        public void SetSource(uint number, Disturbance source)
        {
            source.struct_size = (uint)sizeof(Disturbance);
            using (new Use(owner)) Errors.Check(Native.pelagic_dynamic_waves_set_source(waves, number, &source));
        }

        /// <summary>Removes a source. Does nothing if no source has that number.</summary>
        public void RemoveSource(uint number)
        {
            using (new Use(owner)) Errors.Check(Native.pelagic_dynamic_waves_remove_source(waves, number));
        }

        /// <summary>Moves the grid's centre to within half a texel of a point.</summary>
        public void SetCenter(double xM, double zM)
        {
            using (new Use(owner)) Errors.Check(Native.pelagic_dynamic_waves_set_center(waves, xM, zM));
        }

        public void SetRain(Rain rain)
        {
            rain.struct_size = (uint)sizeof(Rain);
            using (new Use(owner)) Errors.Check(Native.pelagic_dynamic_waves_set_rain(waves, &rain));
        }

        /// <summary>Computes the ticks up to a time. Frames advance the waves of an ocean.</summary>
        public void Advance(double timeS)
        {
            using (new Use(owner)) Errors.Check(Native.pelagic_dynamic_waves_advance(waves, timeS));
            ++steps.Count;
        }

        /// <summary>
        /// The waves of the last Advance(), valid until the second from now. Those of an ocean are in its frames.
        /// </summary>
        public DynamicWavesView View
        {
            get
            {
                if (!isOwned) throw new InvalidOperationException("The waves of an ocean are Frame.DynamicWaves.");
                var slot = slots[views & 1];
                if (slot.Step != steps.Count)
                {
                    slot = slots[++views & 1];
                    using (new Use(owner))
                    fixed (Native.pelagic_dynamic_waves_view* view = &slot.View)
                        Errors.Check(Native.pelagic_dynamic_waves_get_view(waves, view));
                    slot.Step = steps.Count;
                    slot.Begin(views);
                }
                return new DynamicWavesView(slot, slot.Number, slot.View);
            }
        }

        /// <summary>64-bit hash of the waves.</summary>
        public ulong Hash()
        {
            ulong hash;
            using (new Use(owner)) Errors.Check(Native.pelagic_dynamic_waves_hash(waves, &hash));
            return hash;
        }

        /// <summary>Saves all that later ticks depend on, except commands since the last advance.</summary>
        public byte[] SaveState()
        {
            using (new Use(owner))
            {
                UIntPtr count;
                Errors.Check(Native.pelagic_dynamic_waves_save_state(waves, null, UIntPtr.Zero, &count));
                var bytes = new byte[checked((int)count)];
                fixed (byte* first = bytes) Errors.Check(Native.pelagic_dynamic_waves_save_state(waves, first, count, &count));
                return bytes;
            }
        }

        /// <summary>Restores a state saved with equal options.</summary>
        public void RestoreState(ReadOnlySpan<byte> bytes)
        {
            using (new Use(owner))
            fixed (byte* first = &MemoryMarshal.GetReference(bytes))
                Errors.Check(Native.pelagic_dynamic_waves_restore_state(waves, first, (UIntPtr)bytes.Length));
        }

        /// <summary>Destroys the waves. Those of an ocean live as long as the ocean.</summary>
        public void Dispose()
        {
            if (isOwned) owner.Dispose();
        }
    }

    /// <summary>
    /// The grid of dynamic waves. Texel (i, j) of the world's grid has the position x = i TexelM, z = j TexelM, and is
    /// in column i mod N of row j mod N. FirstX &lt;= i &lt; FirstX + N, FirstZ &lt;= j &lt; FirstZ + N.
    /// </summary>
    public readonly unsafe struct DynamicWavesView
    {
        private readonly Slot slot;
        private readonly long number;
        private readonly Native.pelagic_dynamic_waves_view view;

        internal DynamicWavesView(Slot slot, long number, in Native.pelagic_dynamic_waves_view view)
        {
            this.slot = slot;
            this.number = number;
            this.view = view;
        }

        /// <summary>N.</summary>
        public int Resolution => view.resolution;
        public long FirstX => view.first_x;
        public long FirstZ => view.first_z;
        public double TexelM => view.texel_m;
        public float HeightMinM => view.height_min_m;
        public float HeightMaxM => view.height_max_m;
        /// <summary>N^2 heights, 0 at the grid's edges.</summary>
        public ReadOnlySpan<float> HeightM => new ReadOnlySpan<float>(Checked(view.height_m), Texels);
        public ReadOnlySpan<float> VerticalVelocityMps => new ReadOnlySpan<float>(Checked(view.vertical_velocity_mps), Texels);
        public ReadOnlySpan<byte> Foam => new ReadOnlySpan<byte>(Checked(view.foam), Texels);

        private int Texels => view.resolution * view.resolution;

        private void* Checked(void* memory)
        {
            if (slot == null) throw new InvalidOperationException("No waves: they are those of Frame.DynamicWaves or DynamicWaves.View.");
            slot.Require(number);
            return memory;
        }
    }
}
