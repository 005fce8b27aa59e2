using System;
using System.Runtime.InteropServices;

namespace Pelagic
{
    public sealed unsafe partial class HullOptions
    {
        /// <summary>Three coordinates in the axes of the mesh; null: the centre of its volume.</summary>
        public double[] CentreOfMassM;
        /// <summary>
        /// Three moments of inertia about the axes through the centre of mass, [1e-15, 1e16]; null: those of a body
        /// that fills the mesh evenly.
        /// </summary>
        public double[] InertiaKgm2;
        /// <summary>
        /// Added mass at rest, 6 x 6 numbers by rows: surge, heave, sway, roll, yaw, pitch; null: derived from the
        /// sizes of waterline and draught.
        /// </summary>
        public double[] AddedMass;

        /// <summary>The default coefficients.</summary>
        public HullOptions(double massKg)
        {
            CopyFrom(Native.pelagic_hull_options_make());
            MassKg = massKg;
        }

        internal void Write(ref Native.pelagic_hull_options native)
        {
            RequireLength(CentreOfMassM, 3, "CentreOfMassM");
            RequireLength(InertiaKgm2, 3, "InertiaKgm2");
            RequireLength(AddedMass, 36, "AddedMass");
            native.struct_size = (uint)sizeof(Native.pelagic_hull_options);
            CopyTo(ref native);
        }

        private static void RequireLength(double[] values, int length, string name)
        {
            if (values != null && values.Length != length) throw new ArgumentException($"{name} needs {length} elements.");
        }
    }

    /// <summary>
    /// Mesh, mass and coefficients of hulls of one kind. One thread at a time calls ComputeLoads() and Accelerate();
    /// other members may be used by any thread.
    /// </summary>
    public sealed unsafe class Hull : IDisposable
    {
        internal readonly HullHandle Handle;

        /// <summary>
        /// Creates a hull from a closed mesh, wound counter-clockwise as seen from outside: x, y and z of each
        /// vertex, and the numbers of the three vertices of each triangle, 4 to 4096 of them. Axes: x forward, y up,
        /// z to starboard.
        /// </summary>
        public Hull(ReadOnlySpan<double> verticesM, ReadOnlySpan<uint> triangles, HullOptions options)
        {
            if (options == null) throw new ArgumentNullException(nameof(options));
            if (verticesM.Length % 3 != 0 || triangles.Length % 3 != 0)
                throw new ArgumentException("Vertices and triangles need three numbers each.");
            fixed (double* vertices = &MemoryMarshal.GetReference(verticesM), centre = options.CentreOfMassM, inertia = options.InertiaKgm2, addedMass = options.AddedMass)
            fixed (uint* numbers = &MemoryMarshal.GetReference(triangles))
            {
                var mesh = new Native.pelagic_hull_mesh
                {
                    struct_size = (uint)sizeof(Native.pelagic_hull_mesh),
                    vertex_count = (UIntPtr)(verticesM.Length / 3),
                    vertices_m = vertices,
                    triangle_count = (UIntPtr)(triangles.Length / 3),
                    triangles = numbers,
                };
                var native = default(Native.pelagic_hull_options);
                options.Write(ref native);
                native.centre_of_mass_m = centre;
                native.inertia_kgm2 = inertia;
                native.added_mass = addedMass;
                IntPtr hull;
                Errors.Check(Native.pelagic_hull_create(&mesh, &native, &hull));
                Handle = new HullHandle(hull, new CallbackRoot[0]);
            }
        }

        public HullInfo Info
        {
            get
            {
                HullInfo info;
                using (var use = new Use(Handle)) Errors.Check(Native.pelagic_hull_describe(use.Pointer, &info));
                return info;
            }
        }

        /// <summary>The hull upright and at rest in still water. The heading is from +x to +z.</summary>
        public HullState AtRest(double xM, double zM, double headingRad = 0)
        {
            HullState state;
            using (var use = new Use(Handle)) Errors.Check(Native.pelagic_hull_at_rest(use.Pointer, xM, zM, headingRad, &state));
            return state;
        }

        /// <summary>
        /// Computes the loads of a state in the water of the frame completed last. For a physics engine that
        /// integrates positions: it sets pose and velocities, and applies the total. Successive calls are stepS
        /// apart. Of the inputs only the wind is used.
        /// </summary>
        public HullLoads ComputeLoads(Ocean ocean, ref HullState state, double stepS, HullInputs inputs = default)
        {
            return Compute(ocean, ref state, stepS, inputs, false);
        }

        /// <summary>
        /// Computes loads, and the velocities of the state after a step under them, the weight and the inputs, with
        /// mass and added mass. For a physics engine without added mass: it sets the body's velocities to the result.
        /// </summary>
        public HullLoads Accelerate(Ocean ocean, ref HullState state, double stepS, HullInputs inputs = default)
        {
            return Compute(ocean, ref state, stepS, inputs, true);
        }

        private HullLoads Compute(Ocean ocean, ref HullState state, double stepS, HullInputs inputs, bool accelerates)
        {
            if (ocean == null) throw new ArgumentNullException(nameof(ocean));
            var changed = state;
            inputs.struct_size = (uint)sizeof(HullInputs);
            HullLoads loads;
            using (var use = new Use(Handle))
            using (var water = new Use(ocean.Handle))
                Errors.Check(accelerates
                                 ? Native.pelagic_hull_accelerate(use.Pointer, water.Pointer, &changed, stepS, &inputs, &loads)
                                 : Native.pelagic_hull_compute_loads(use.Pointer, water.Pointer, &changed, stepS, &inputs, &loads));
            state = changed;
            return loads;
        }

        /// <summary>Releases the handle. Bodies that use the hull keep what they need.</summary>
        public void Dispose()
        {
            Handle.Dispose();
        }
    }
}
