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

        /// <summary>64-bit hash of the droplets of the frame completed last.</summary>
        public ulong SprayHash() => HashOf(Pelagic.Hash.Spray);

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
