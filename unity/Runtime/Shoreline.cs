using System;

namespace Pelagic
{
    public sealed unsafe partial class ShoreOptions
    {
        /// <summary>Columns * Rows heights above the rest level; sample (i, j) is element j * Columns + i.</summary>
        public float[] HeightsM;

        /// <summary>The defaults: no samples, 1 m between them, 256 texels, a derived swash.</summary>
        public ShoreOptions()
        {
            CopyFrom(Native.pelagic_shore_options_make());
        }

        internal void Write(ref Native.pelagic_shore_options native)
        {
            if (HeightsM == null || HeightsM.Length != (long)Columns * Rows)
                throw new ArgumentException("HeightsM needs Columns * Rows elements.");
            native.struct_size = (uint)sizeof(Native.pelagic_shore_options);
            CopyTo(ref native);
        }
    }

    /// <summary>
    /// The waves at a shore. Texel (i, j) has the position XM + i TexelM, ZM + j TexelM and is element
    /// j * Columns + i. Valid as long as its frame.
    /// </summary>
    public readonly unsafe struct Shoreline
    {
        private readonly FrameSlot slot;
        private readonly long number;

        internal Shoreline(FrameSlot slot, long number)
        {
            this.slot = slot;
            this.number = number;
        }

        public int Columns => Of.columns;
        public int Rows => Of.rows;
        public double TexelM => Of.texel_m;
        public double XM => Of.x_m;
        public double ZM => Of.z_m;
        public float HeightMinM => Of.height_min_m;
        public float HeightMaxM => Of.height_max_m;
        /// <summary>Largest change of a weight between positions a metre apart.</summary>
        public float WeightsChangePerM => Of.weights_change_per_m;
        /// <summary>Depth of still water; below 0 on land.</summary>
        public ReadOnlySpan<float> DepthM => new ReadOnlySpan<float>(Of.depth_m, Texels);
        /// <summary>Weight of cascade t in byte t from the lowest up, 255 for 1.</summary>
        public ReadOnlySpan<uint> WeightsRgba8 => new ReadOnlySpan<uint>(Of.weights_rgba8, Texels);
        public ReadOnlySpan<float> HeightM => new ReadOnlySpan<float>(Of.height_m, Texels);
        public ReadOnlySpan<float> VerticalVelocityMps => new ReadOnlySpan<float>(Of.vertical_velocity_mps, Texels);
        /// <summary>Envelope of the crests of the passing waves: sand below it is wet.</summary>
        public ReadOnlySpan<float> ReachM => new ReadOnlySpan<float>(Of.reach_m, Texels);
        /// <summary>Of breaking waves.</summary>
        public ReadOnlySpan<byte> Foam => new ReadOnlySpan<byte>(Of.foam, Texels);
        /// <summary>Velocity potential, whose gradient is the horizontal velocity of these waves.</summary>
        public ReadOnlySpan<float> PotentialM2ps => new ReadOnlySpan<float>(Of.potential_m2ps, Texels);

        private ref Native.pelagic_shore_surface Of
        {
            get
            {
                if (slot == null) throw new InvalidOperationException("No shoreline: it is that of Frame.Shoreline.");
                slot.Require(number);
                return ref slot.Shore;
            }
        }

        private int Texels => Of.columns * Of.rows;
    }
}
