using System;
using System.Runtime.InteropServices;

namespace Pelagic
{
    /// <summary>Counts the steps that end views: schedules of an ocean, advances of dynamic waves.</summary>
    internal sealed class Steps
    {
        internal readonly SafeHandle Owner;
        internal long Count;

        internal Steps(SafeHandle owner)
        {
            Owner = owner;
        }
    }

    /// <summary>Memory of the library that is valid until the second step from now.</summary>
    internal abstract class Slot
    {
        private readonly Steps steps;
        private long end;
        internal long Number;

        protected Slot(Steps steps)
        {
            this.steps = steps;
        }

        internal void Begin(long number)
        {
            Number = number;
            end = steps.Count + 2;
        }

        internal void Require(long number)
        {
            if (steps.Owner.IsClosed) throw new ObjectDisposedException(nameof(Ocean));
            if (Number != number || steps.Count >= end) throw new InvalidOperationException("The frame is over: it ends at the second schedule.");
        }
    }

    internal sealed unsafe class FrameSlot : Slot
    {
        internal Native.pelagic_frame Frame;
        internal readonly Native.pelagic_cascade[] Cascades = new Native.pelagic_cascade[4];
        internal Native.pelagic_shore_surface Shore;
        internal Native.pelagic_dynamic_waves_view Waves;
        internal (double X, double Z) Origin;
        internal WaterFrame Water;

        internal FrameSlot(Steps steps) : base(steps) { }

        internal void Read(IntPtr ocean, IntPtr waves, bool hasShore)
        {
            for (var i = 0; i < Frame.cascade_count; ++i)
                fixed (Native.pelagic_cascade* cascade = &Cascades[i])
                    Errors.Check(Native.pelagic_ocean_cascade(ocean, i, cascade));
            if (hasShore)
                fixed (Native.pelagic_shore_surface* shore = &Shore)
                    Errors.Check(Native.pelagic_ocean_shore(ocean, shore));
            if (waves != IntPtr.Zero)
                fixed (Native.pelagic_dynamic_waves_view* view = &Waves)
                    Errors.Check(Native.pelagic_dynamic_waves_get_view(waves, view));
        }
    }

    /// <summary>
    /// A frame in the ocean's memory. Its properties throw InvalidOperationException from the second Schedule()
    /// after its Complete() on, and ObjectDisposedException after Dispose(). A span or pointer that was taken
    /// before is then invalid, without a check.
    /// </summary>
    public readonly unsafe struct Frame
    {
        private readonly FrameSlot slot;
        private readonly long number;

        internal Frame(FrameSlot slot)
        {
            this.slot = slot;
            number = slot.Number;
        }

        public double TimeS => Slot.Frame.time_s;
        /// <summary>The world's origin, as of Ocean.SetOrigin().</summary>
        public double OriginXM => Slot.Origin.X;
        public double OriginZM => Slot.Origin.Z;
        /// <summary>
        /// Sea level and current, as of Ocean.SetWaterFrame(). The frame's x = 0 lies at CurrentXMps TimeS - OriginXM in the
        /// world, and z likewise.
        /// </summary>
        public WaterFrame Water => Slot.Water;
        /// <summary>Significant wave height, mean over all seeds.</summary>
        public double WaveHeightM => Slot.Frame.wave_height_m;
        /// <summary>N, texels along a side of each cascade.</summary>
        public int Resolution => Slot.Frame.resolution;
        public int CascadeCount => Slot.Frame.cascade_count;
        /// <summary>Of the sum of all cascades.</summary>
        public Bounds Bounds => Slot.Frame.bounds;
        /// <summary>GGX's alpha of the waves that no cascade holds; [0, 1].</summary>
        public float Roughness => Slot.Frame.roughness;
        public double FoamDriftXMps => Slot.Frame.foam_drift_x_mps;
        public double FoamDriftZMps => Slot.Frame.foam_drift_z_mps;
        /// <summary>Compression of half foam: 1000 if the sea has no whitecaps, and without OceanOptions.Foam.</summary>
        public float FoamLevel => Slot.Frame.foam_level;

        /// <summary>Age of snapshot `index` of 16; 1 and more: the snapshot has no effect.</summary>
        public float FoamAge(int index)
        {
            if ((uint)index >= 16) throw new ArgumentOutOfRangeException(nameof(index));
            fixed (float* ages = Slot.Frame.foam_age) return ages[index];
        }

        /// <summary>A cascade; 0 is the coarsest.</summary>
        public Cascade Cascade(int index)
        {
            if ((uint)index >= (uint)CascadeCount) throw new ArgumentOutOfRangeException(nameof(index));
            return new Cascade(slot, number, index);
        }

        /// <summary>The waves at the shore, of an ocean with OceanOptions.Shore.</summary>
        public Shoreline Shoreline
        {
            get
            {
                if (Slot.Shore.columns == 0) throw new InvalidOperationException("The ocean has no shore.");
                return new Shoreline(slot, number);
            }
        }

        /// <summary>The dynamic waves, of an ocean with OceanOptions.DynamicWaves.</summary>
        public DynamicWavesView DynamicWaves
        {
            get
            {
                if (Slot.Waves.resolution == 0) throw new InvalidOperationException("The ocean has no dynamic waves.");
                return new DynamicWavesView(slot, number, slot.Waves);
            }
        }

        /// <summary>
        /// Droplets of emitters, then those of crests, each with the newest first; empty without OceanOptions.Spray.
        /// Droplets below the water are not removed.
        /// </summary>
        public ReadOnlySpan<Droplet> Droplets => new ReadOnlySpan<Droplet>(Slot.Frame.droplets, (int)Slot.Frame.droplet_count);

        private FrameSlot Slot
        {
            get
            {
                if (slot == null) throw new InvalidOperationException("No frame: it is that of Ocean.Complete().");
                slot.Require(number);
                return slot;
            }
        }
    }

    /// <summary>
    /// A cascade of a frame: a wavelength band and its square domain of SideM metres with N texels a side. Texel
    /// (i, j) has the undisplaced position x = (Cosine i - Sine j) SideM / N, z = (Sine i + Cosine j) SideM / N.
    /// Valid as long as its frame. A span that the ocean was made without is empty.
    /// </summary>
    public readonly unsafe struct Cascade
    {
        private readonly FrameSlot slot;
        private readonly long number;
        private readonly int index;

        internal Cascade(FrameSlot slot, long number, int index)
        {
            this.slot = slot;
            this.number = number;
            this.index = index;
        }

        public int Resolution => Of.resolution;
        public double SideM => Of.side_m;
        public double Cosine => Of.cosine;
        public double Sine => Of.sine;
        public Bounds Bounds => Of.bounds;
        public float SlopeRange => Of.slope_range;
        public float VarianceRange => Of.variance_range;
        public float CompressionScale => Of.compression_scale;
        public float CompressionFrontX => Of.compression_front_x;
        public float CompressionFrontZ => Of.compression_front_z;
        public double DriftColumns => Of.drift_columns;
        public double DriftRows => Of.drift_rows;

        public Plane Dx => new Plane(slot, number, Of.dx);
        public Plane Height => new Plane(slot, number, Of.height);
        public Plane Dz => new Plane(slot, number, Of.dz);
        /// <summary>In m/s; with Velocities.Drawn.</summary>
        public Plane VelocityX => new Plane(slot, number, Of.velocity_x);
        public Plane VelocityY => new Plane(slot, number, Of.velocity_y);
        public Plane VelocityZ => new Plane(slot, number, Of.velocity_z);

        /// <summary>Number of levels of each chain of mipmaps.</summary>
        public int Levels => Of.levels;

        /// <summary>First texel of a level in each chain.</summary>
        public int LevelOffset(int level)
        {
            if ((uint)level >= (uint)Levels) throw new ArgumentOutOfRangeException(nameof(level));
            fixed (uint* offsets = Of.level_offset) return (int)offsets[level];
        }

        /// <summary>N^2 texels of four half floats: Dx, height, Dz, 0.</summary>
        public ReadOnlySpan<ushort> DisplacementRgba16f
        {
            get
            {
                ref readonly var of = ref Of;
                return of.displacement_rgba16f == null ? default : new ReadOnlySpan<ushort>(of.displacement_rgba16f, 4 * of.resolution * of.resolution);
            }
        }

        /// <summary>Chain of normal x, normal z, Jacobian and smoothness.</summary>
        public ReadOnlySpan<uint> GradientRgba8 => Chain(Of.gradient_rgba8);
        /// <summary>Chain of derivatives; (byte - 128) / 127 * SlopeRange.</summary>
        public ReadOnlySpan<uint> SlopesRgba8 => Chain(Of.slopes_rgba8);
        public ReadOnlySpan<uint> MomentsRgba8 => Chain(Of.moments_rgba8);
        /// <summary>N^2 bytes of compression; with OceanOptions.Foam.</summary>
        public ReadOnlySpan<byte> CompressionR8
        {
            get
            {
                ref readonly var of = ref Of;
                return of.compression_r8 == null ? default : new ReadOnlySpan<byte>(of.compression_r8, of.resolution * of.resolution);
            }
        }

        /// <summary>Chain of snapshots 4 index to 4 index + 3; index in [0, 4).</summary>
        public ReadOnlySpan<uint> SnapshotsRgba8(int index) => Chain(Of.snapshots_rgba8(index));

        /// <summary>Differs whenever the image of snapshots differs.</summary>
        public ulong SnapshotsVersion(int index)
        {
            if ((uint)index >= 4) throw new ArgumentOutOfRangeException(nameof(index));
            fixed (ulong* versions = Of.snapshots_version) return versions[index];
        }

        private ref Native.pelagic_cascade Of
        {
            get
            {
                if (slot == null) throw new InvalidOperationException("No cascade: it is that of Frame.Cascade().");
                slot.Require(number);
                return ref slot.Cascades[index];
            }
        }

        private ReadOnlySpan<uint> Chain(uint* texels)
        {
            return texels == null ? default : new ReadOnlySpan<uint>(texels, (4 * Of.resolution * Of.resolution - 1) / 3);
        }
    }

    /// <summary>
    /// A square array of floats in blocks of columns. Texel (i, j) is
    /// Data[i / BlockColumns * BlockStride + j * RowStride + i % BlockColumns].
    /// </summary>
    public readonly unsafe struct Plane
    {
        private readonly Slot slot;
        private readonly long number;
        private readonly Native.pelagic_plane plane;

        internal Plane(Slot slot, long number, Native.pelagic_plane plane)
        {
            this.slot = slot;
            this.number = number;
            this.plane = plane;
        }

        /// <summary>True if the ocean was made without this plane.</summary>
        public bool IsEmpty => plane.data == null;
        public int Resolution => plane.resolution;
        public int BlockColumns => plane.block_columns;
        public int RowStride => (int)plane.row_stride;
        public int BlockStride => (int)plane.block_stride;

        /// <summary>All of the plane, empty if it is.</summary>
        public ReadOnlySpan<float> Data
        {
            get
            {
                slot.Require(number);
                if (plane.data == null) return default;
                var last = plane.resolution - 1;
                return new ReadOnlySpan<float>(plane.data, Offset(last, last) + 1);
            }
        }

        /// <summary>Texel of column i and row j.</summary>
        public float this[int i, int j]
        {
            get
            {
                if ((uint)i >= (uint)plane.resolution || (uint)j >= (uint)plane.resolution) throw new IndexOutOfRangeException();
                slot.Require(number);
                if (plane.data == null) throw new InvalidOperationException("The ocean was made without this plane.");
                return plane.data[Offset(i, j)];
            }
        }

        private int Offset(int i, int j)
        {
            return i / plane.block_columns * BlockStride + j * RowStride + i % plane.block_columns;
        }
    }
}
