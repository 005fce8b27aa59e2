using System;
using System.Collections.Generic;
using System.Linq;
using Pelagic;

public static class QuadtreeTests
{
    private static readonly double[][] viewers = { new double[] { 0, 2, 0 }, new double[] { 313.7, 1.7, -271.3 }, new double[] { -9000.25, 180, 4500.5 } };

    private static Quadtree All(double size, int vertices, double lodScale, double[] viewer)
    {
        var quadtree = new Quadtree(size, vertices, lodScale);
        quadtree.Select(viewer[0], viewer[1], viewer[2], default, default);
        return quadtree;
    }

    /// <summary>Displacement of a vertex: a function that is nowhere linear, morphed as in quadtree/patch_vertex.hpp.</summary>
    private static double Displaced(Quadtree quadtree, in QuadtreePatch patch, int i, int j)
    {
        int x = patch.CornerX + i * quadtree.Stride(patch.Level), z = patch.CornerZ + j * quadtree.Stride(patch.Level);
        if (i % 2 == 0 && j % 2 == 0) return Wave(x, z);
        var weight = patch.InnerWeight;
        if (i == 0) weight = patch.WestWeight;
        if (i == quadtree.Vertices) weight = patch.EastWeight;
        if (j == 0) weight = patch.SouthWeight;
        if (j == quadtree.Vertices) weight = patch.NorthWeight;
        int offsetX = i % 2 * quadtree.Stride(patch.Level), offsetZ = j % 2 * quadtree.Stride(patch.Level);
        if (i % 2 == 1 && j % 2 == 1 && (i / 2 + j / 2 + patch.Diagonals) % 2 == 1) offsetZ = -offsetZ;
        return weight * Wave(x, z) + (1 - weight) * 0.5 * (Wave(x - offsetX, z - offsetZ) + Wave(x + offsetX, z + offsetZ));
    }

    private static double Wave(int x, int z) => Math.Sin(1.3 * x + 0.7 * z) + Math.Cos(0.11 * x * z);

    [Test]
    public static void TheSurfaceHasNoCracks()
    {
        foreach (var viewer in viewers)
        {
            const int V = 8;
            var quadtree = All(2048, V, 1.8, viewer);
            var heights = new Dictionary<(int, int), double>();
            var edges = new HashSet<((int, int), (int, int))>();
            for (var p = 0; p < quadtree.Count; ++p)
            {
                var patch = quadtree[p];
                var indices = Quadtree.Triangles(V, patch.Stitches);
                for (var t = 0; t < indices.Length; t += 3)
                {
                    var corners = new (int x, int z)[3];
                    for (var k = 0; k < 3; ++k)
                    {
                        int i = indices[t + k] % (V + 1), j = indices[t + k] / (V + 1);
                        corners[k] = (patch.CornerX + i * quadtree.Stride(patch.Level), patch.CornerZ + j * quadtree.Stride(patch.Level));
                        var height = Displaced(quadtree, patch, i, j);
                        if (heights.TryGetValue(corners[k], out var known)) Check.True(known == height, "patches agree on a vertex that they share");
                        heights[corners[k]] = height;
                    }
                    // Counter-clockwise seen from above: x to the right, z downwards.
                    Check.True((corners[1].z - corners[0].z) * (corners[2].x - corners[0].x) > (corners[1].x - corners[0].x) * (corners[2].z - corners[0].z), "orientation");
                    for (var k = 0; k < 3; ++k) Check.True(edges.Add((corners[k], corners[(k + 1) % 3])), "an edge of one triangle on each side");
                }
            }
            foreach (var edge in edges)
            {
                int fromX = edge.Item1.Item1, fromZ = edge.Item1.Item2, toX = edge.Item2.Item1, toZ = edge.Item2.Item2;
                var isBorder = fromX == toX && (fromX == 0 || fromX == quadtree.Side) || fromZ == toZ && (fromZ == 0 || fromZ == quadtree.Side);
                Check.True(isBorder || edges.Contains(((toX, toZ), (fromX, fromZ))), "an edge inside the square has two triangles");
            }
        }
    }

    [Test]
    public static void PatchesAreThoseOfTheLibrary()
    {
        foreach (var preset in new[] { ("low", 16, 1.8), ("high", 64, 2.2) })
            for (var i = 0; i < viewers.Length; ++i)
            {
                var quadtree = All(2048, preset.Item2, preset.Item3, viewers[i]);
                int[] levels = new int[quadtree.DeepestLevel + 1], stitches = new int[16];
                var triangles = 0;
                for (var p = 0; p < quadtree.Count; ++p)
                {
                    ++levels[quadtree[p].Level];
                    ++stitches[(int)quadtree[p].Stitches];
                    triangles += Quadtree.Triangles(preset.Item2, quadtree[p].Stitches).Length / 3;
                }
                Check.Equal($"{triangles}:{string.Join(",", levels)}:{string.Join(",", stitches)}", Expected.Text($"quadtree {preset.Item1} {i}"), "patches");
            }
    }

    // A view to the horizon through a pyramid of four planes, against a search of all vertices.
    [Test]
    public static void PatchesOfAViewAreAllThatItSees()
    {
        var bounds = new Bounds { HeightMinM = -2, HeightMaxM = 3, HorizontalXMaxM = 1, HorizontalZMaxM = 2 };
        var planes = new double[] { 0.8, 0, 0.6, -2, 0.8, 0, -0.6, 2, 0.2, 0.98, 0, -3, 0.2, -0.98, 0, 3 };
        var all = All(2048, 16, 1.8, viewers[1]);
        var seen = new Quadtree(2048, 16, 1.8);
        seen.Select(viewers[1][0], viewers[1][1], viewers[1][2], planes, bounds);
        var corners = new HashSet<(int, int)>();
        for (var p = 0; p < seen.Count; ++p) corners.Add((seen[p].CornerX, seen[p].CornerZ));
        var visible = 0;
        for (var p = 0; p < all.Count; ++p)
        {
            var patch = all[p];
            int[] steps = Enumerable.Range(0, 17).Select(i => i * all.Stride(patch.Level)).ToArray();
            var isVisible = steps.Any(x => steps.Any(z => new[] { -2.0, 3.0 }.Any(y =>
                Enumerable.Range(0, 4).All(i => planes[4 * i] * (all.CornerX + patch.CornerX + x) * all.StepM + planes[4 * i + 1] * y +
                                                planes[4 * i + 2] * (all.CornerZ + patch.CornerZ + z) * all.StepM + planes[4 * i + 3] >= 0))));
            if (!isVisible) continue;
            ++visible;
            Check.True(corners.Contains((patch.CornerX, patch.CornerZ)), "a visible patch");
        }
        // Boxes are a little larger than what is visible.
        Check.True(visible > 20 && seen.Count < 2 * visible && seen.Count < all.Count, $"{visible} of {seen.Count} of {all.Count} patches");
    }

    [Test]
    public static void WrongOptionsAreRejected()
    {
        Check.Throws<ArgumentOutOfRangeException>(() => new Quadtree(100, 16), "100 m");
        Check.Throws<ArgumentOutOfRangeException>(() => new Quadtree(2048, 15), "15 steps");
        Check.Throws<ArgumentOutOfRangeException>(() => new Quadtree(2048, 16, 9), "a scale of 9");
        Check.Throws<ArgumentOutOfRangeException>(() => new Quadtree(2048, 16, 2, 8), "patches of 8 m");
        Check.Throws<ArgumentException>(() => new Quadtree(2048, 16).Select(double.NaN, 0, 0, default, default), "no position");
    }
}
