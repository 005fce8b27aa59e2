namespace Pelagic
{
    public partial struct WaveSystem
    {
        /// <summary>The default system, of jonswap and a wind of 12 m/s. All other systems begin with it.</summary>
        public static WaveSystem Default => Native.pelagic_wave_system_make();
    }

    public unsafe partial struct Sea
    {
        /// <summary>The default sea. All other seas begin with it or a preset: zeros are not valid.</summary>
        public static Sea Default => Native.pelagic_sea_make();

        /// <summary>
        /// A preset: "calm", "lake", "swell", "moderate", "rough", "storm", "pond", "analytic-calm",
        /// "analytic-moderate", "analytic-intense", or "beaufort-0" to "beaufort-12".
        /// </summary>
        public static Sea Preset(string name)
        {
            var sea = default(Sea).Sized();
            fixed (byte* bytes = Errors.BytesOf(name)) Errors.Check(Native.pelagic_sea_preset(bytes, &sea));
            return sea;
        }

        /// <summary>Throws a PelagicException that names the first invalid field.</summary>
        public void Check()
        {
            var sea = Sized();
            Errors.Check(Native.pelagic_sea_check(&sea));
        }

        /// <summary>Computes statistics, which takes as long as the creation of an ocean.</summary>
        public Statistics Statistics()
        {
            var sea = Sized();
            Statistics statistics;
            Errors.Check(Native.pelagic_sea_statistics(&sea, &statistics));
            return statistics;
        }

        internal Sea Sized()
        {
            var sea = this;
            sea.struct_size = (uint)sizeof(Sea);
            return sea;
        }
    }
}
