using System;
using System.Runtime.InteropServices;

namespace Pelagic
{
    /// <summary>
    /// Hulls that float in the water of an ocean. With wakes they press on its dynamic waves, and float on the waves
    /// of others. A tick is Complete() of the ocean, Press(), Schedule() of the ocean, and Step(). One thread at a
    /// time calls methods of a set; with wakes that thread calls Add(), Remove(), Press() and Dispose(), and methods
    /// of the ocean. Step() may run beside methods of the ocean. Steps allocate nothing.
    /// </summary>
    public sealed unsafe class Bodies : IDisposable
    {
        private readonly Ocean ocean;
        private readonly BodiesHandle handle;
        private readonly CallbackRoot root;

        /// <summary>
        /// Creates an empty set in an ocean with queries and depth. wakes: needs OceanOptions.DynamicWaves.
        /// executor: computes the steps; null for the default one.
        /// </summary>
        public Bodies(Ocean ocean, bool wakes = false, Executor executor = null)
        {
            this.ocean = ocean ?? throw new ArgumentNullException(nameof(ocean));
            root = executor?.Root;
            using (var water = new Use(ocean.Handle))
            using (var use = new Use(executor?.Handle))
            {
                var options = new Native.pelagic_bodies_options
                {
                    struct_size = (uint)sizeof(Native.pelagic_bodies_options),
                    wakes = wakes ? 1 : 0,
                    executor = use.Pointer,
                };
                IntPtr bodies;
                Errors.Check(Native.pelagic_bodies_create(water.Pointer, &options, &bodies));
                root?.Add();
                handle = new BodiesHandle(bodies, root == null ? new CallbackRoot[0] : new[] { root });
            }
            ocean.Keep(handle);
        }

        /// <summary>Adds a body without inputs. Returns its number, which is never reused.</summary>
        public uint Add(Hull hull, HullState state)
        {
            if (hull == null) throw new ArgumentNullException(nameof(hull));
            uint number;
            using (new Use(ocean.Handle))
            using (var kind = new Use(hull.Handle))
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_bodies_add(use.Pointer, kind.Pointer, &state, &number));
            return number;
        }

        /// <summary>Removes a body. Does nothing if no body has that number.</summary>
        public void Remove(uint number)
        {
            using (new Use(ocean.Handle))
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_bodies_remove(use.Pointer, number));
        }

        /// <summary>Sets force and wind of the steps from now on.</summary>
        public void SetInputs(uint number, HullInputs inputs)
        {
            inputs.struct_size = (uint)sizeof(HullInputs);
            using (new Use(ocean.Handle))
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_bodies_set_inputs(use.Pointer, number, &inputs));
        }

        /// <summary>Replaces the state of a body.</summary>
        public void SetState(uint number, HullState state)
        {
            using (new Use(ocean.Handle))
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_bodies_set_state(use.Pointer, number, &state));
        }

        /// <summary>The state of a body.</summary>
        public HullState State(uint number)
        {
            HullState state;
            using (new Use(ocean.Handle))
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_bodies_get_state(use.Pointer, number, &state));
            return state;
        }

        /// <summary>The loads of a body in the last step.</summary>
        public HullLoads Loads(uint number)
        {
            HullLoads loads;
            using (new Use(ocean.Handle))
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_bodies_get_loads(use.Pointer, number, &loads));
            return loads;
        }

        /// <summary>
        /// Moves all bodies and their wakes, after a shift of the world's origin (Ocean.SetOrigin()) by (-xM, -zM).
        /// Call it when the first frame with the new origin is complete, before Press() and Step().
        /// </summary>
        public void Shift(double xM, double zM)
        {
            using (new Use(ocean.Handle))
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_bodies_shift(use.Pointer, xM, zM));
        }

        /// <summary>
        /// Moves the pressures of wakes to the bodies, once a frame between Complete() and Schedule() of the ocean.
        /// tickS: time since the last call. Frames may be any time apart. Does nothing without wakes.
        /// </summary>
        public void Press(double tickS)
        {
            using (new Use(ocean.Handle))
            using (var use = new Use(handle)) Errors.Check(Native.pelagic_bodies_press(use.Pointer, tickS));
        }

        /// <summary>
        /// Advances all bodies by a step in the water of the frame completed last. More than 0.1 s is divided into
        /// equal steps. More than 1 s counts as 1 s, and the result is false then.
        /// </summary>
        public bool Step(double stepS)
        {
            Status status;
            int isAll = 1;
            using (new Use(ocean.Handle))
            using (var use = new Use(handle)) status = Native.pelagic_bodies_step(use.Pointer, stepS, &isAll);
            if (root?.TakeFailure() is Exception failure)
                throw new PelagicException(Status.ApplicationError, "A callback threw: " + failure.Message, failure);
            Errors.Check(status);
            return isAll != 0;
        }

        /// <summary>
        /// Saves all that later steps depend on, inputs and wakes included. Call it when the state of the dynamic waves
        /// is saved, before the first command after a frame.
        /// </summary>
        public byte[] SaveState()
        {
            using (new Use(ocean.Handle))
            using (var use = new Use(handle))
            {
                UIntPtr count;
                Errors.Check(Native.pelagic_bodies_save_state(use.Pointer, null, UIntPtr.Zero, &count));
                var bytes = new byte[checked((int)count)];
                fixed (byte* first = bytes) Errors.Check(Native.pelagic_bodies_save_state(use.Pointer, first, count, &count));
                return bytes;
            }
        }

        /// <summary>
        /// Restores a saved state, whose hulls were added to this set. With wakes, restore the dynamic waves first.
        /// </summary>
        public void RestoreState(ReadOnlySpan<byte> bytes)
        {
            using (new Use(ocean.Handle))
            using (var use = new Use(handle))
            fixed (byte* first = &MemoryMarshal.GetReference(bytes))
                Errors.Check(Native.pelagic_bodies_restore_state(use.Pointer, first, (UIntPtr)bytes.Length));
        }

        /// <summary>Destroys the set, and removes its pressures from the dynamic waves.</summary>
        public void Dispose()
        {
            ocean.Forget(handle);
            handle.Dispose();
        }
    }
}
