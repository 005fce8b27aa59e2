using System;
using System.Collections.Generic;

namespace Pelagic
{
    /// <summary>Sides of a patch, bits of QuadtreePatch.Stitches.</summary>
    [Flags]
    public enum PatchSides
    {
        East = 1,
        North = 2,
        West = 4,
        South = 8,
    }

    /// <summary>A patch of a quadtree. Weights, 0 to 1, are those of vertices that the coarser level lacks.</summary>
    public struct QuadtreePatch
    {
        /// <summary>Steps from the grid's corner to the patch's.</summary>
        public int CornerX, CornerZ;
        /// <summary>0: the whole grid.</summary>
        public int Level;
        /// <summary>1 flips the diagonals of the coarser level.</summary>
        public int Diagonals;
        public float InnerWeight, EastWeight, NorthWeight, WestWeight, SouthWeight;
        /// <summary>Sides whose neighbour is coarser.</summary>
        public PatchSides Stitches;
    }

    /// <summary>
    /// Selects patches of a square of sea around a viewer, as the library's renderer does: neighbours differ by at
    /// most one level, and vertices morph between levels, so that the surface has no cracks and nothing pops.
    /// Positions are in the sea's axes. After construction nothing is allocated.
    /// </summary>
    public sealed class Quadtree
    {
        // Fraction of the squared distance over which a split's weight goes from 0 to 1.
        private const float MorphZone = 0.25f;

        private readonly double lodScale;
        private readonly Window[] windows;
        private readonly QuadtreePatch[] found;
        private readonly Node[] stack;
        private readonly double[] planes = new double[24];
        private int planeCount;
        private double low, high, marginX, marginZ;

        /// <summary>
        /// sizeM: side of the square, [256, 8192]. vertices: steps along a patch, even, [2, 128]. lodScale: a patch
        /// splits nearer than this times its side, [0.75, 8]. finestPatchM: side of the smallest patches, about,
        /// [16, 64].
        /// </summary>
        public Quadtree(double sizeM, int vertices, double lodScale = 2.2, double finestPatchM = 64)
        {
            if (!(sizeM >= 256 && sizeM <= 8192)) throw new ArgumentOutOfRangeException(nameof(sizeM));
            if (vertices < 2 || vertices > 128 || vertices % 2 != 0) throw new ArgumentOutOfRangeException(nameof(vertices));
            if (!(lodScale >= 0.75 && lodScale <= 8)) throw new ArgumentOutOfRangeException(nameof(lodScale));
            if (!(finestPatchM >= 16 && finestPatchM <= 64)) throw new ArgumentOutOfRangeException(nameof(finestPatchM));
            SizeM = sizeM;
            Vertices = vertices;
            this.lodScale = lodScale;
            DeepestLevel = Math.Min(Math.Max((int)Math.Floor(Math.Log(sizeM / finestPatchM, 2) + 0.5), 2), 8);
            Side = vertices << DeepestLevel;
            StepM = sizeM / Side;
            windows = new Window[DeepestLevel];
            int side = 0, patches = 1;
            for (var level = DeepestLevel - 1; level >= 0; --level)
            {
                var disc = (int)(2 * lodScale * Math.Sqrt(ReachSquared(level))) + 4;
                side = Math.Min(Math.Max(disc, side / 2 + 3) + 2, 1 << level);
                windows[level].Measures = new float[side * side];
                patches += 3 * side * side;
            }
            found = new QuadtreePatch[patches];
            stack = new Node[4 + 3 * DeepestLevel];
        }

        public double SizeM { get; }
        /// <summary>V, steps along a patch.</summary>
        public int Vertices { get; }
        /// <summary>Steps along the square.</summary>
        public int Side { get; }
        public double StepM { get; }
        public int DeepestLevel { get; }

        /// <summary>Lowest x and z of the square, in steps from the world's origin.</summary>
        public long CornerX { get; private set; }
        public long CornerZ { get; private set; }
        /// <summary>Along x and z from the viewer, displacement is full up to here, and zero from FadeEndM on.</summary>
        public double FadeStartM => SizeM * 5 / 16;
        public double FadeEndM => SizeM * 3 / 8;

        /// <summary>Number of patches of the last Select().</summary>
        public int Count { get; private set; }

        /// <summary>Patch `index` of the last Select().</summary>
        public ref readonly QuadtreePatch this[int index]
        {
            get
            {
                if ((uint)index >= (uint)Count) throw new IndexOutOfRangeException();
                return ref found[index];
            }
        }

        /// <summary>Steps between vertices of a patch of this level.</summary>
        public int Stride(int level) => 1 << (DeepestLevel - level);

        /// <summary>
        /// Selects patches for a viewer; y is above still water. planes: six of a view, four numbers (a, b, c, d)
        /// each with a x + b y + c z + d >= 0 inside; empty: all patches. bounds: those of the frame.
        /// </summary>
        public void Select(double x, double y, double z, ReadOnlySpan<double> planes, in Bounds bounds)
        {
            // False for NaN. Steps are exact up to here.
            if (!(Math.Abs(x) <= 1e8 && Math.Abs(y) <= 1e8 && Math.Abs(z) <= 1e8)) throw new ArgumentException("The viewer is not within 1e8 m of the origin.");
            if (planes.Length > this.planes.Length || planes.Length % 4 != 0) throw new ArgumentException("Planes have four numbers each, and are at most six.");
            planes.CopyTo(this.planes);
            planeCount = planes.Length / 4;
            low = Math.Min(bounds.HeightMinM, 0);
            high = Math.Max(bounds.HeightMaxM, 0);
            marginX = bounds.HorizontalXMaxM;
            marginZ = bounds.HorizontalZMaxM;

            double snap = SizeM / 4;
            CornerX = (long)Math.Floor(x / snap + 0.5) * (Side / 4) - Side / 2;
            CornerZ = (long)Math.Floor(z / snap + 0.5) * (Side / 4) - Side / 2;
            double viewerX = x - CornerX * StepM, viewerZ = z - CornerZ * StepM;
            for (var level = DeepestLevel - 1; level >= 0; --level)
            {
                Open(level, viewerX, y, viewerZ);
                if (level + 1 < DeepestLevel) RaiseParents(level + 1);
            }
            Walk();
        }

        /// <summary>
        /// Triangles of a patch with this stitching: indices i + j (V + 1) of vertices (i, j), counter-clockwise from
        /// above in the sea's axes.
        /// </summary>
        public static ushort[] Triangles(int vertices, PatchSides stitches)
        {
            // A fan around the middle of each 3 x 3 vertices, without midpoints of sides whose neighbour is coarser.
            int[] ringX = { 2, 2, 2, 1, 0, 0, 0, 1 }, ringZ = { 2, 1, 0, 0, 0, 1, 2, 2 };
            PatchSides[] sideOf = { PatchSides.East, PatchSides.South, PatchSides.West, PatchSides.North };
            var indices = new List<ushort>();
            var kept = new List<ushort>();
            for (var z = 0; z < vertices; z += 2)
                for (var x = 0; x < vertices; x += 2)
                {
                    var touched = default(PatchSides);
                    if (x == vertices - 2) touched |= PatchSides.East;
                    if (z == vertices - 2) touched |= PatchSides.North;
                    if (x == 0) touched |= PatchSides.West;
                    if (z == 0) touched |= PatchSides.South;
                    kept.Clear();
                    for (var k = 0; k < 8; ++k)
                        if (k % 2 == 0 || (stitches & touched & sideOf[k / 2]) == 0)
                            kept.Add((ushort)(x + ringX[k] + (z + ringZ[k]) * (vertices + 1)));
                    for (var k = 0; k < kept.Count; ++k)
                    {
                        indices.Add((ushort)(x + 1 + (z + 1) * (vertices + 1)));
                        indices.Add(kept[k]);
                        indices.Add(kept[(k + 1) % kept.Count]);
                    }
                }
            return indices.ToArray();
        }

        // Each level adds MorphZone to its demand, so nodes further away cause no split.
        private static double ReachSquared(int level) => 1 + MorphZone * level;

        private static int ToCell(double x, int cells) => (int)Math.Floor(Math.Min(Math.Max(x, 0), cells));

        /// <summary>Computes the measure of the nodes near the viewer: 1 - d^2 / (lodScale side)^2.</summary>
        private void Open(int level, double viewerX, double viewerY, double viewerZ)
        {
            ref var w = ref windows[level];
            var cells = 1 << level;
            double side = SizeM / cells, range = side * lodScale;
            var radiusSquared = range * range * ReachSquared(level) - viewerY * viewerY;
            w.X0 = w.X1 = w.Z0 = w.Z1 = 0;
            if (radiusSquared > 0)
            {
                double radius = Math.Sqrt(radiusSquared) / side, x = viewerX / side - 0.5, z = viewerZ / side - 0.5;
                w.X0 = ToCell(x - radius, cells);
                w.X1 = ToCell(x + radius + 1, cells);
                w.Z0 = ToCell(z - radius, cells);
                w.Z1 = ToCell(z + radius + 1, cells);
                if (w.X0 >= w.X1 || w.Z0 >= w.Z1) w.X0 = w.X1 = w.Z0 = w.Z1 = 0;
            }
            if (level + 1 < DeepestLevel && windows[level + 1].X1 > windows[level + 1].X0)
            {
                ref var finer = ref windows[level + 1];
                var isEmpty = w.X0 == w.X1;
                Widen(ref w.X0, ref w.X1, finer.X0, finer.X1, isEmpty, cells);
                Widen(ref w.Z0, ref w.Z1, finer.Z0, finer.Z1, isEmpty, cells);
            }
            for (var z = w.Z0; z < w.Z1; ++z)
                for (var x = w.X0; x < w.X1; ++x)
                {
                    double dx = (x + 0.5) * side - viewerX, dz = (z + 0.5) * side - viewerZ;
                    w.At(x, z) = (float)(1 - (dx * dx + dz * dz + viewerY * viewerY) / (range * range));
                }
        }

        private static void Widen(ref int low, ref int high, int from, int to, bool isEmpty, int cells)
        {
            int parentsFrom = Math.Max((from - 1) >> 1, 0), parentsTo = Math.Min((to >> 1) + 1, cells);
            low = isEmpty ? parentsFrom : Math.Min(low, parentsFrom);
            high = isEmpty ? parentsTo : Math.Max(high, parentsTo);
        }

        /// <summary>
        /// Splits the parents of each node that splits, and those of its neighbours, completely before it begins.
        /// </summary>
        private void RaiseParents(int level)
        {
            ref var finer = ref windows[level];
            ref var coarser = ref windows[level - 1];
            for (var z = finer.Z0; z < finer.Z1; ++z)
                for (var x = finer.X0; x < finer.X1; ++x)
                {
                    var demand = MorphZone + Math.Min(finer.At(x, z), 0);
                    coarser.Raise(x >> 1, z >> 1, demand);
                    // Two neighbours are siblings; the other two lie on this node's side of its parent.
                    coarser.Raise((x >> 1) + (x % 2 == 0 ? -1 : 1), z >> 1, demand);
                    coarser.Raise(x >> 1, (z >> 1) + (z % 2 == 0 ? -1 : 1), demand);
                }
        }

        private float Measure(int level, int x, int z)
        {
            if (level >= DeepestLevel) return -1;
            ref var w = ref windows[level];
            return w.Holds(x, z) ? w.At(x, z) : -1;
        }

        // In 65,535 steps, as the library's draw lists have them.
        private static float Weight(float measure) => (float)Math.Floor(Math.Min(Math.Max(measure / MorphZone, 0), 1) * 65535f + 0.5f) / 65535f;

        private void Walk()
        {
            Count = 0;
            var waiting = 0;
            stack[waiting++] = default;
            while (waiting > 0)
            {
                var node = stack[--waiting];
                if (!IsVisible(node)) continue;
                if (!(Measure(node.Level, node.X, node.Z) > 0))
                {
                    Emit(node);
                    continue;
                }
                for (var child = 3; child >= 0; --child)
                    stack[waiting++] = new Node { Level = node.Level + 1, X = 2 * node.X + child % 2, Z = 2 * node.Z + child / 2 };
            }
        }

        private bool IsVisible(in Node node)
        {
            double side = SizeM / (1 << node.Level), half = side / 2;
            double x = CornerX * StepM + (node.X + 0.5) * side, z = CornerZ * StepM + (node.Z + 0.5) * side;
            for (var i = 0; i < planeCount; ++i)
            {
                double a = planes[4 * i], b = planes[4 * i + 1], c = planes[4 * i + 2];
                var reach = Math.Abs(a) * (half + marginX) + Math.Abs(b) * (high - low) / 2 + Math.Abs(c) * (half + marginZ);
                if (a * x + b * (low + high) / 2 + c * z + planes[4 * i + 3] + reach < 0) return false;
            }
            return true;
        }

        private void Emit(in Node node)
        {
            ref var patch = ref found[Count++];
            var side = Side >> node.Level;
            patch = new QuadtreePatch
            {
                CornerX = node.X * side,
                CornerZ = node.Z * side,
                Level = node.Level,
                // The diagonals alternate over the whole parent. A child starts at a multiple of V/2 squares in it.
                Diagonals = (node.X + node.Z) * (Vertices / 2) & 1,
                InnerWeight = node.Level == 0 ? 1 : Weight(Measure(node.Level - 1, node.X >> 1, node.Z >> 1)),
            };
            patch.EastWeight = EdgeWeight(node, 1, 0, PatchSides.East, ref patch);
            patch.NorthWeight = EdgeWeight(node, 0, 1, PatchSides.North, ref patch);
            patch.WestWeight = EdgeWeight(node, -1, 0, PatchSides.West, ref patch);
            patch.SouthWeight = EdgeWeight(node, 0, -1, PatchSides.South, ref patch);
        }

        /// <summary>The smaller weight of both patches of an edge.</summary>
        private float EdgeWeight(in Node node, int stepX, int stepZ, PatchSides side, ref QuadtreePatch patch)
        {
            if (node.Level == 0) return 1;
            int parents = 1 << (node.Level - 1), x = (node.X + stepX) >> 1, z = (node.Z + stepZ) >> 1;
            var isSibling = x == node.X >> 1 && z == node.Z >> 1;
            if (isSibling || x < 0 || z < 0 || x >= parents || z >= parents) return patch.InnerWeight;
            var measure = Measure(node.Level - 1, x, z);
            if (!(measure > 0)) patch.Stitches |= side;
            return Math.Min(patch.InnerWeight, Weight(measure));
        }

        private struct Node
        {
            internal int Level, X, Z;
        }

        /// <summary>Measures of the nodes [X0, X1) x [Z0, Z1) of a level; others are not split.</summary>
        private struct Window
        {
            internal int X0, X1, Z0, Z1;
            internal float[] Measures;

            internal bool Holds(int x, int z) => x >= X0 && x < X1 && z >= Z0 && z < Z1;
            internal ref float At(int x, int z) => ref Measures[(z - Z0) * (X1 - X0) + x - X0];

            internal void Raise(int x, int z, float demand)
            {
                if (Holds(x, z)) At(x, z) = Math.Max(At(x, z), demand);
            }
        }
    }
}
