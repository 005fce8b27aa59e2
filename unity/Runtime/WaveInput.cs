using System;
using System.Runtime.InteropServices;

namespace Pelagic
{
    /// <summary>
    /// Rows of a cascade that a callback fills: column i of row FirstRow + j is element j N + i. All values are 0
    /// before the call. Valid until the callback returns.
    /// </summary>
    public readonly unsafe ref struct InputRows
    {
        private readonly Native.pelagic_input_rows* rows;

        internal InputRows(Native.pelagic_input_rows* rows)
        {
            this.rows = rows;
        }

        /// <summary>Index of the cascade; 0 is the coarsest.</summary>
        public int Cascade => rows->cascade;
        public double TimeS => rows->time_s;
        public double LoopPeriodS => rows->loop_period_s;
        /// <summary>Position in the loop, in units of 2^-32 of it.</summary>
        public uint LoopTurns => rows->loop_turns;
        /// <summary>A tick of foam accumulation, at a time before the frame's.</summary>
        public bool IsTick => rows->is_tick != 0;
        public double SideM => rows->side_m;
        public double Cosine => rows->cosine;
        public double Sine => rows->sine;
        /// <summary>N.</summary>
        public int Resolution => rows->resolution;
        public int FirstRow => rows->first_row;
        public int RowCount => rows->row_count;
        public Span<float> Dx => Of(rows->dx);
        public Span<float> Height => Of(rows->height);
        public Span<float> Dz => Of(rows->dz);
        /// <summary>Empty without OceanOptions.Velocities, and in ticks.</summary>
        public Span<float> VelocityX => Of(rows->velocity_x);
        public Span<float> VelocityY => Of(rows->velocity_y);
        public Span<float> VelocityZ => Of(rows->velocity_z);

        private Span<float> Of(float* values)
        {
            return values == null ? default : new Span<float>(values, rows->resolution * rows->row_count);
        }
    }

    /// <summary>
    /// Writes the waves of some rows. Called from any thread, for several rows and cascades at once. The
    /// exception of Complete() has its exception as the inner one.
    /// </summary>
    public delegate void RowWriter(InputRows rows);

    /// <summary>
    /// Waves that are added to the cascades of one ocean, by OceanOptions.Inputs. New values take effect at the
    /// next Schedule().
    /// </summary>
    public sealed unsafe class WaveInput : IDisposable
    {
        private static readonly Native.pelagic_add_rows addRows = OnAddRows;

        internal readonly InputHandle Handle;
        internal readonly CallbackRoot Root;

        private WaveInput(Status status, IntPtr input, CallbackRoot root)
        {
            if (status != Status.Ok)
            {
                root?.Release();
                throw Errors.Of(status);
            }
            Root = root;
            Handle = new InputHandle(input, root == null ? new CallbackRoot[0] : new[] { root });
        }

        /// <summary>
        /// Gerstner waves in deep water, at most 64: amplitudes, wavelengths, directions from +x to +z, and phases,
        /// which may be empty. Choppiness 1: water moves in circles, 0: a height field.
        /// </summary>
        public static WaveInput Waves(ReadOnlySpan<double> amplitudeM, ReadOnlySpan<double> wavelengthM, ReadOnlySpan<double> directionRad,
                                      ReadOnlySpan<double> phaseRad = default, double choppiness = 1)
        {
            fixed (double* amplitude = &MemoryMarshal.GetReference(amplitudeM), wavelength = &MemoryMarshal.GetReference(wavelengthM),
                   direction = &MemoryMarshal.GetReference(directionRad), phase = &MemoryMarshal.GetReference(phaseRad))
            {
                RequireEqual(amplitudeM.Length, wavelengthM.Length, directionRad.Length, phaseRad.Length);
                var waves = WavesOf(amplitudeM.Length, amplitude, wavelength, direction, phase, choppiness);
                IntPtr input;
                return new WaveInput(Native.pelagic_input_create_waves(&waves, &input), input, null);
            }
        }

        /// <summary>Replaces the waves of an input of Gerstner waves.</summary>
        public void SetWaves(ReadOnlySpan<double> amplitudeM, ReadOnlySpan<double> wavelengthM, ReadOnlySpan<double> directionRad,
                             ReadOnlySpan<double> phaseRad = default, double choppiness = 1)
        {
            fixed (double* amplitude = &MemoryMarshal.GetReference(amplitudeM), wavelength = &MemoryMarshal.GetReference(wavelengthM),
                   direction = &MemoryMarshal.GetReference(directionRad), phase = &MemoryMarshal.GetReference(phaseRad))
            using (var use = new Use(Handle))
            {
                RequireEqual(amplitudeM.Length, wavelengthM.Length, directionRad.Length, phaseRad.Length);
                var waves = WavesOf(amplitudeM.Length, amplitude, wavelength, direction, phase, choppiness);
                Errors.Check(Native.pelagic_input_set_waves(use.Pointer, &waves));
            }
        }

        /// <summary>Rings that run outwards from a point.</summary>
        public static WaveInput Rings(Ripple ripple)
        {
            ripple.struct_size = (uint)sizeof(Ripple);
            IntPtr input;
            return new WaveInput(Native.pelagic_input_create_ripple(&ripple, &input), input, null);
        }

        /// <summary>Replaces the rings of an input of rings.</summary>
        public void SetRings(Ripple ripple)
        {
            ripple.struct_size = (uint)sizeof(Ripple);
            using (var use = new Use(Handle)) Errors.Check(Native.pelagic_input_set_ripple(use.Pointer, &ripple));
        }

        /// <summary>
        /// Waves that a callback writes. Bit i of cascades: cascade i; 0: all. Slopes beyond largestSlope are
        /// clamped in SlopesRgba8; [0, 100]. An ocean with ExecutorKind.Tbb refuses it.
        /// </summary>
        public static WaveInput Callback(RowWriter writer, double largestSlope, uint cascades = 0)
        {
            if (writer == null) throw new ArgumentNullException(nameof(writer));
            var root = new CallbackRoot(writer);
            var callback = new Native.pelagic_input_callback
            {
                struct_size = (uint)sizeof(Native.pelagic_input_callback),
                cascades = cascades,
                add = Marshal.GetFunctionPointerForDelegate(addRows),
                user = (void*)root.Pointer,
                largest_slope = largestSlope,
            };
            IntPtr input;
            return new WaveInput(Native.pelagic_input_create_callback(&callback, &input), input, root);
        }

        /// <summary>Releases the handle. An ocean that uses the input keeps what it needs.</summary>
        public void Dispose()
        {
            Handle.Dispose();
        }

        private static void RequireEqual(int amplitudes, int wavelengths, int directions, int phases)
        {
            if (wavelengths != amplitudes || directions != amplitudes || (phases != 0 && phases != amplitudes))
                throw new ArgumentException("Arrays of waves differ in length.");
        }

        private static Native.pelagic_waves WavesOf(int count, double* amplitude, double* wavelength, double* direction, double* phase, double choppiness)
        {
            return new Native.pelagic_waves
            {
                struct_size = (uint)sizeof(Native.pelagic_waves),
                count = (UIntPtr)count,
                amplitude_m = amplitude,
                wavelength_m = wavelength,
                direction_rad = direction,
                phase_rad = phase,
                choppiness = choppiness,
            };
        }

        [MonoPInvokeCallback(typeof(Native.pelagic_add_rows))]
        private static void OnAddRows(void* user, Native.pelagic_input_rows* rows)
        {
            var root = CallbackRoot.At(user);
            try
            {
                ((RowWriter)root.Target)(new InputRows(rows));
            }
            catch (Exception exception)
            {
                root.Record(exception);
                rows->height[0] = float.NaN;  // the library rejects it, so that the frame fails
            }
        }
    }
}
