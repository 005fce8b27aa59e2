using System;
using System.Collections.Generic;
using System.Linq;
using Pelagic;
using Pelagic.Unity;
using UnityEngine;

public static class OceanSurfaceTests
{
    private static readonly Vector3 viewer = new Vector3(40.5f, 3, -310.25f);
    private static readonly Vector3 sun = new Vector3(0.48f, 0.6f, 0.64f);  // towards it, in the scene

    private sealed class Scene : IDisposable
    {
        internal readonly OceanBehaviour Behaviour = new OceanBehaviour { Preset = "storm", Resolution = 32 };
        internal readonly OceanSurface Surface;

        internal Scene()
        {
            UnityEngine.Time.timeAsDouble = 3;
            RenderSettings.ambientProbe = new UnityEngine.Rendering.SphericalHarmonicsL2 { Uniform = new Color(0.1f, 0.2f, 0.3f, 1) };
            Surface = new OceanSurface { Source = Behaviour, Camera = new Camera(), Sun = new Light { color = new Color(1, 0.5f, 0.25f, 1), intensity = 2 }, Material = new Material() };
            Surface.Camera.transform.position = viewer;
            // A view of 90 degrees along +z of the scene.
            Surface.Camera.cullingMatrix = new Matrix4x4
            {
                Row0 = new Vector4(1, 0, 0, -viewer.x),
                Row1 = new Vector4(0, 1, 0, -viewer.y),
                Row2 = new Vector4(0, 0, 1, -viewer.z - 0.2f),
                Row3 = new Vector4(0, 0, 1, -viewer.z),
            };
            Surface.Sun.transform.forward = new Vector3(-sun.x, -sun.y, -sun.z);
            Graphics.Draws.Clear();
            BehaviourTests.Send(Behaviour, "OnEnable");
            BehaviourTests.Send(Surface, "OnEnable");
            BehaviourTests.Send(Behaviour, "Update");
            BehaviourTests.Send(Surface, "LateUpdate");
        }

        internal Vector4 Vector(string name) => (Vector4)Surface.Material[name];
        internal Vector4[] Vectors(string name) => (Vector4[])Surface.Material[name];

        public void Dispose()
        {
            BehaviourTests.Send(Surface, "OnDisable");
            BehaviourTests.Send(Behaviour, "OnDisable");
        }
    }

    [Test]
    public static void TheSeaStaysInPlaceWhenTheOriginIsShifted()
    {
        using (var scene = new Scene())
        {
            var before = (Vector4[])scene.Vectors("_PelagicCascadePlace").Clone();
            var ripples = scene.Vector("_PelagicDetailPlace");
            scene.Behaviour.SetOrigin(1024, -512);
            scene.Surface.Camera.transform.position = new Vector3(viewer.x - 1024, viewer.y, viewer.z - 512);
            // The first frame was scheduled before the shift.
            BehaviourTests.Send(scene.Behaviour, "Update");
            Check.Equal(scene.Behaviour.Frame.OriginXM, 0.0, "origin of the frame in flight");
            BehaviourTests.Send(scene.Behaviour, "Update");
            Check.Equal(scene.Behaviour.Frame.OriginXM, 1024.0, "origin");
            BehaviourTests.Send(scene.Surface, "LateUpdate");
            var after = scene.Vectors("_PelagicCascadePlace");
            for (var i = 0; i < after.Length; ++i) Check.True(Math.Abs(after[i].x - before[i].x) + Math.Abs(after[i].y - before[i].y) < 1e-5, "place of cascade " + i);
            Check.True(Math.Abs(scene.Vector("_PelagicDetailPlace").x - ripples.x) < 1e-5, "place of ripples");
        }
    }

    [Test]
    public static void EachPatchIsDrawnOnceWithItsTriangles()
    {
        using (var scene = new Scene())
        {
            var quadtree = scene.Surface.Quadtree;
            var drawn = new HashSet<(float, float)>();
            foreach (var draw in Graphics.Draws)
            {
                Check.True(draw.Item2.Submeshes[draw.Item3].SequenceEqual(Quadtree.Triangles(32, (PatchSides)draw.Item3)), "triangles of the stitching");
                var patches = draw.Item1.matProps["_PelagicPatches"];
                for (var i = 0; i < draw.Item4; ++i)
                {
                    Vector4 patch = patches[2 * i], edges = patches[2 * i + 1];
                    Check.True(drawn.Add((patch.x, patch.y)), "a patch is drawn once");
                    var found = Enumerable.Range(0, quadtree.Count).Select(p => quadtree[p]).Single(of => of.CornerX == patch.x && of.CornerZ == patch.y);
                    Check.True((int)found.Stitches == draw.Item3 && 2 * found.Level + found.Diagonals == patch.z && found.InnerWeight == patch.w, "a patch");
                    Check.True(found.EastWeight == edges.x && found.NorthWeight == edges.y && found.WestWeight == edges.z && found.SouthWeight == edges.w, "its edges");
                    // The view sees z of the scene above the camera's, which is -z of the sea.
                    var north = (quadtree.CornerZ + found.CornerZ) * quadtree.StepM;
                    Check.True(north < -viewer.z + scene.Behaviour.Frame.Bounds.HorizontalZMaxM, "a patch ahead of the camera");
                }
            }
            Check.True(drawn.Count == quadtree.Count && drawn.Count > 30, $"{drawn.Count} patches");
            Check.True(Graphics.Draws.Select(draw => draw.Item1.matProps).Distinct().Count() == Graphics.Draws.Count, "each draw has properties of its own");
        }
    }

    // By the documented position of a texel (pelagic_cascade).
    [Test]
    public static void TextureCoordinatesFindTheTexelOfAPosition()
    {
        using (var scene = new Scene())
            for (var c = 0; c < 4; ++c)
            {
                var cascade = scene.Behaviour.Frame.Cascade(c);
                int n = cascade.Resolution, i = 7, j = n - 3;
                double texel = cascade.SideM / n, x = (cascade.Cosine * i - cascade.Sine * j) * texel, z = (cascade.Sine * i + cascade.Cosine * j) * texel;
                double eastward = x - viewer.x, southward = z + viewer.z;  // relative to the viewer
                var place = scene.Vectors("_PelagicCascadePlace")[c];
                double u = place.x + place.z * eastward + place.w * southward, v = place.y + place.z * southward - place.w * eastward;
                // Floats: 1e-7 of hundreds of metres, in periods of at least 1 m.
                Check.True(Math.Abs(u * n - i - 0.5 - n * Math.Round((u * n - i - 0.5) / n)) < 0.01, "column");
                Check.True(Math.Abs(v * n - j - 0.5 - n * Math.Round((v * n - j - 0.5) / n)) < 0.01, "row");
                Check.True(Math.Abs(scene.Vectors("_PelagicCascadeScale")[c].x * texel - 1) < 1e-6, "texels per metre");
            }
    }

    [Test]
    public static void LightIsThatOfTheScene()
    {
        using (var scene = new Scene())
        {
            Vector4 towards = scene.Vector("_PelagicSun"), power = scene.Vector("_PelagicSunIrradiance"), ray = scene.Vector("_PelagicCrestRay");
            Check.True(towards.x == sun.x && towards.y == sun.y && towards.z == -sun.z, "z is mirrored");
            Check.True(Math.Abs(power.y - Math.PI) < 1e-6 && Math.Abs(scene.Vector("_PelagicSkyIrradiance").z - 0.3 * Math.PI) < 1e-6, "irradiance");
            // Snell's law at the back of a wave, whose slope is 0.25: tangential parts of the rays differ by the index.
            double across = 0.25 / Math.Sqrt(1.0625), up = 1 / Math.Sqrt(1.0625), level = Math.Sqrt(0.64);
            double bx = across * towards.x / level, bz = across * towards.z / level;
            double inAir = Math.Sqrt(1 - Math.Pow(bx * towards.x + up * towards.y + bz * towards.z, 2)), normal = bx * ray.x + up * ray.y + bz * ray.z;
            Check.True(Math.Abs(ray.x * ray.x + ray.y * ray.y + ray.z * ray.z - 1) < 1e-6 && normal < 0, "a ray into the water");
            Check.True(Math.Abs(Math.Sqrt(1 - normal * normal) * 1.333 - inAir) < 1e-5, "refraction");
            // Fresnel: at 39 degrees water reflects 2.4 %.
            var entering = scene.Vector("_PelagicCrestSun").y / power.y * 1.333 * 1.333 * -normal / Math.Sqrt(1 - inAir * inAir);
            Check.True(Math.Abs(entering - 0.976) < 0.002, $"{entering} of the light enters");
        }
    }

    [Test]
    public static void ADisabledSurfaceDestroysItsTexturesAndMesh()
    {
        var scene = new Scene();
        UnityEngine.Object.Destroyed.Clear();
        BehaviourTests.Send(scene.Surface, "OnDisable");
        Check.Equal(UnityEngine.Object.Destroyed.Count, 3, "destroyed objects");
        BehaviourTests.Send(scene.Surface, "OnEnable");
        BehaviourTests.Send(scene.Surface, "LateUpdate");
        scene.Dispose();
        BehaviourTests.Send(scene.Surface, "LateUpdate");  // without an ocean nothing is drawn
    }
}
