using System;
using System.Runtime.InteropServices;

namespace Pelagic
{
    public partial struct SprayOptions
    {
        /// <summary>Seed 1, a reach of 80 m, amount 1.</summary>
        public static SprayOptions Default => Native.pelagic_spray_options_make();
    }

    public partial struct SprayEmitter
    {
        /// <summary>One droplet of 0.05 m at rest at the origin and t = 0, of drops of 1 mm.</summary>
        public static SprayEmitter Default => Native.pelagic_spray_emitter_make();
    }

    /// <summary>Arrays for the droplets of any frame, in the world; the first Count elements are theirs.</summary>
    public sealed class Droplets
    {
        /// <summary>Largest number of droplets of a frame.</summary>
        public const int Max = 8192;

        public int Count { get; internal set; }
        public readonly double[] XM = new double[Max], YM = new double[Max], ZM = new double[Max];
        public readonly float[] VelocityXMps = new float[Max], VelocityYMps = new float[Max], VelocityZMps = new float[Max];
        public readonly float[] RadiusM = new float[Max];
        /// <summary>At the middle of the droplet, 0 to 1.</summary>
        public readonly float[] Opacity = new float[Max];
        /// <summary>Since it left the water.</summary>
        public readonly float[] AgeS = new float[Max];
    }

    // Spray of OceanOptions.Spray.
    public sealed unsafe partial class Ocean
    {
        /// <summary>
        /// Sets the centre of the spray of crests, usually the camera. It takes effect at the next Schedule(), for the
        /// ticks computed from then on.
        /// </summary>
        public void SetSprayCenter(double xM, double zM)
        {
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_ocean_set_spray_center(use.Pointer, xM, zM));
        }

        /// <summary>Adds droplets of an emitter to frames that are scheduled from now on.</summary>
        public void Emit(SprayEmitter emitter)
        {
            emitter.struct_size = (uint)sizeof(SprayEmitter);
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_ocean_emit(use.Pointer, &emitter, (UIntPtr)1));
        }

        /// <summary>
        /// Copies the droplets of the frame completed last: first those of emitters, then those of crests, each with
        /// the newest first. Droplets below the water are not removed.
        /// </summary>
        public void ReadDroplets(Droplets into)
        {
            UIntPtr count;
            using (var use = new Use(handle))
            fixed (double* x = into.XM, y = into.YM, z = into.ZM)
            fixed (float* velocityX = into.VelocityXMps, velocityY = into.VelocityYMps, velocityZ = into.VelocityZMps)
            fixed (float* radius = into.RadiusM, opacity = into.Opacity, age = into.AgeS)
            {
                var native = new Native.pelagic_droplets
                {
                    struct_size = (uint)sizeof(Native.pelagic_droplets),
                    room = (UIntPtr)Droplets.Max,
                    x_m = x,
                    y_m = y,
                    z_m = z,
                    velocity_x_mps = velocityX,
                    velocity_y_mps = velocityY,
                    velocity_z_mps = velocityZ,
                    radius_m = radius,
                    opacity = opacity,
                    age_s = age,
                };
                Errors.Check(Native.pelagic_ocean_droplets(use.Pointer, &native, &count));
            }
            into.Count = (int)count;
        }

        /// <summary>64-bit hash of the droplets of the frame completed last.</summary>
        public ulong SprayHash()
        {
            ulong hash;
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_ocean_spray_hash(use.Pointer, &hash));
            return hash;
        }

        /// <summary>Saves the droplets of emitters. No frame may be in flight.</summary>
        public byte[] SaveSpray()
        {
            using (var use = new Use(handle))
            {
                UIntPtr count;
                Errors.Check(Native.pelagic_ocean_save_spray(use.Pointer, null, UIntPtr.Zero, &count));
                var bytes = new byte[checked((int)count)];
                fixed (byte* first = bytes) Errors.Check(Native.pelagic_ocean_save_spray(use.Pointer, first, count, &count));
                return bytes;
            }
        }

        /// <summary>Replaces the droplets of emitters. No frame may be in flight.</summary>
        public void RestoreSpray(ReadOnlySpan<byte> bytes)
        {
            using (var use = new Use(handle))
            fixed (byte* first = &MemoryMarshal.GetReference(bytes))
                Errors.Check(Native.pelagic_ocean_restore_spray(use.Pointer, first, (UIntPtr)bytes.Length));
        }
    }
}
