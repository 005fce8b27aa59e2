using System;
using System.IO;
using System.Linq;
using System.Threading;
using Pelagic;
using Pelagic.Unity;
using Unity.Collections;
using Unity.Jobs;
using UnityEditor;
using UnityEngine;

/// <summary>All components together: garbage, reloads, and the components that have no tests of their own.</summary>
public static class SceneTests
{
    private sealed class Scene
    {
        internal readonly OceanBehaviour Ocean;
        internal readonly OceanSurface Surface;
        internal readonly OceanFloating Alone, Forced;
        internal readonly OceanSpray Spray;
        internal readonly FloatingOrigin Origin;
        internal readonly Rigidbody Body = new Rigidbody { position = new Vector3(20, 0, 0) };

        internal Scene()
        {
            Ocean = new OceanBehaviour { Preset = "storm", Resolution = 32, Depth = true, DynamicWaves = true, Spray = true, Velocities = true, Threads = 2, SprayAmount = 10 };
            var camera = new Camera();
            camera.transform.position = new Vector3(0, 3, 0);
            camera.cullingMatrix = new Matrix4x4
            {
                Row0 = new Vector4(1, 0, 0, 0), Row1 = new Vector4(0, 1, 0, -3), Row2 = new Vector4(0, 0, 1, -0.2f), Row3 = new Vector4(0, 0, 1, 0),
            };
            var sun = new Light { color = new Color(1, 1, 1, 1), intensity = 1 };
            sun.transform.forward = new Vector3(0.6f, -0.8f, 0);
            Surface = new OceanSurface { Source = Ocean, Camera = camera, Sun = sun, Material = new Material() };
            var mesh = OceanFloatingTests.Mesh();
            Alone = new OceanFloating { Ocean = Ocean, Mesh = mesh, MassKg = 2500 };
            Forced = new OceanFloating { Ocean = Ocean, Mesh = mesh, MassKg = 2500, Body = Body };
            foreach (var floating in new[] { Alone, Forced }) floating.transform.forward = new Vector3(0, 0, 1);
            Spray = new OceanSpray { Ocean = Ocean, Particles = new ParticleSystem() };
            Origin = new FloatingOrigin { Ocean = Ocean, Viewer = camera.transform };
            Origin.gameObject.scene = new UnityEngine.SceneManagement.Scene { Roots = new[] { camera.gameObject } };
        }

        // Send() uses reflection, which allocates.
        private static Action Message(MonoBehaviour component, string name)
        {
            return (Action)Delegate.CreateDelegate(typeof(Action), component, name);
        }

        internal Action[] Messages()
        {
            return new[]
            {
                Message(Alone, "FixedUpdate"), Message(Forced, "FixedUpdate"), Message(Ocean, "Update"), Message(Alone, "Update"), Message(Origin, "Update"), Message(Surface, "LateUpdate"),
                Message(Spray, "LateUpdate"),
            };
        }

        internal void Enable()
        {
            BehaviourTests.Send(Ocean, "OnEnable");
            BehaviourTests.Send(Surface, "OnEnable");
        }

        internal void Disable()
        {
            foreach (var component in new MonoBehaviour[] { Ocean, Surface, Alone, Forced, Origin }) BehaviourTests.Send(component, "OnDisable");
        }

        /// <summary>A frame of 1/72 s, with a step of physics.</summary>
        internal void Frame(Action[] messages)
        {
            UnityEngine.Time.timeAsDouble += 1 / 72.0;
            UnityEngine.Time.fixedTimeAsDouble = UnityEngine.Time.timeAsDouble;
            foreach (var message in messages) message();
            Body.Simulate(0.02f);
            Graphics.Draws.Clear();
        }
    }

    [Test]
    public static void AThousandFramesOfASceneAllocateNothing()
    {
        UnityEngine.Time.timeAsDouble = 0;
        IJobParallelForExtensions.HasThreads = false;
        var scene = new Scene();
        scene.Enable();
        var messages = scene.Messages();
        using (var positions = new NativeArray<Vector3>(100, Allocator.Persistent))
        using (var heights = new NativeArray<float>(100, Allocator.Persistent))
            try
            {
                OceanQueries queries = null;
                long bytes = 0;
                int collections = 0, first = int.MaxValue, seas = 0;
                for (var i = 0; i < first + 1000L; ++i)
                {
                    // Lists grow in the first frames, and methods are compiled when they are called first: those of spray at the first droplet.
                    if (first == int.MaxValue && i >= 100 && scene.Spray.Particles.Count > 0)
                    {
                        first = i;
                        bytes = GC.GetAllocatedBytesForCurrentThread();
                        collections = GC.CollectionCount(0);
                    }
                    var windMps = scene.Ocean.Sea.WindSpeedMps;
                    scene.Frame(messages);
                    if (scene.Ocean.Sea.WindSpeedMps != windMps) ++seas;
                    queries = queries ?? new OceanQueries(scene.Ocean.Ocean);
                    queries.Schedule(positions, heights).Complete();
                    // Other seas and shifts, too: sliders and long voyages.
                    if (i % 50 == 0) scene.Ocean.WindSpeedMps = 20 + i % 7;
                    if (i % 90 == 0) scene.Origin.Shift(new Vector3(5, 0, -7));
                }
                Check.Equal(GC.GetAllocatedBytesForCurrentThread() - bytes, 0L, "bytes of 1,000 frames");
                Check.Equal(GC.CollectionCount(0) - collections, 0, "collections");
                Check.True(scene.Ocean.Frame.OriginXM >= 50 && seas >= 10, "the scene runs");
                queries.Dispose();
            }
            finally
            {
                IJobParallelForExtensions.HasThreads = true;
            }
        scene.Disable();
    }

    private static long ResidentBytes()
    {
        GC.Collect();
        var line = File.ReadLines("/proc/self/status").First(text => text.StartsWith("VmRSS:"));
        return 1024 * long.Parse(line.Split(new[] { ' ', '\t' }, StringSplitOptions.RemoveEmptyEntries)[1]);
    }

    private static int Threads() => Directory.GetDirectories("/proc/self/task").Length;

    /// <summary>Each of 50 scenes has a thread of its own, which ends a little later. The pool of mono adds a few.</summary>
    private static void CheckThreads(int count, string what)
    {
        for (var i = 0; Threads() > count + 10 && i < 1000; ++i) Thread.Sleep(5);
        Check.True(Threads() <= count + 10, $"{what}: {Threads()} threads, {count} before");
    }

    [Test]
    public static void FiftyScenesLeaveNothing()
    {
        int threads = 0, live = Texture2DArray.Live;
        long bytes = 0;
        for (var i = 0; i < 60; ++i)
        {
            UnityEngine.Object.Destroyed.Clear();
            if (i == 10)
            {
                threads = Threads();
                bytes = ResidentBytes();
            }
            var scene = new Scene();
            scene.Enable();
            var messages = scene.Messages();
            for (var frame = 0; frame < 3; ++frame) scene.Frame(messages);
            // With a frame and a sea in flight.
            scene.Ocean.WindSpeedMps = 11;
            scene.Frame(messages);
            scene.Disable();
            Check.Equal(Texture2DArray.Live, live, "textures");
        }
        CheckThreads(threads, "50 scenes");
        var grown = ResidentBytes() - bytes;
        // An ocean of a scene has 5 MB.
        Check.True(grown < 25e6, $"{grown} bytes");
    }

    private static void LeaveASceneInFlight()
    {
        var scene = new Scene();
        BehaviourTests.Send(scene.Ocean, "OnEnable");
        foreach (var component in new MonoBehaviour[] { scene.Ocean, scene.Alone, scene.Forced, scene.Ocean })
            BehaviourTests.Send(component, component == scene.Ocean ? "Update" : "FixedUpdate");
    }

    /// <summary>As after a change of scripts; Unity disables components first, and here none is disabled.</summary>
    [Test]
    public static void FiftyDomainsUnload()
    {
        var threads = 0;
        long bytes = 0;
        for (var i = 0; i < 52; ++i)
        {
            if (i == 2)
            {
                threads = Threads();
                bytes = ResidentBytes();
            }
            var domain = AppDomain.CreateDomain("scripts", null, AppDomain.CurrentDomain.SetupInformation);
            domain.DoCallBack(LeaveASceneInFlight);
            var unload = new Thread(() => AppDomain.Unload(domain)) { IsBackground = true };
            unload.Start();
            Check.True(unload.Join(60000), "the domain unloads");
        }
        CheckThreads(threads, "50 domains");
        var grown = ResidentBytes() - bytes;
        // A scene has 5 MB, of which the stubs' textures stay: 0.5 MB.
        Check.True(grown < 50e6, $"{grown} bytes");
    }

    [Test]
    public static void TheSceneMovesWithTheOriginOfItsFrame()
    {
        UnityEngine.Time.timeAsDouble = 4;
        var scene = new Scene();
        scene.Origin.DistanceM = 1000;
        var buoy = new GameObject();
        var viewer = scene.Surface.Camera.gameObject;
        scene.Origin.gameObject.scene = new UnityEngine.SceneManagement.Scene { Roots = new[] { viewer, buoy } };
        buoy.transform.position = new Vector3(1100, 1, -20);
        viewer.transform.position = new Vector3(1200, 3, -30);
        scene.Enable();
        BehaviourTests.Send(scene.Ocean, "Update");
        var before = scene.Ocean.HeightAt(buoy.transform.position);
        var synchronised = Physics.Synchronised;
        for (var i = 0; i < 3; ++i)
        {
            BehaviourTests.Send(scene.Origin, "Update");
            BehaviourTests.Send(scene.Ocean, "Update");
            // The water at the buoy stays, in each frame: time does not pass.
            Check.True(Math.Abs(scene.Ocean.HeightAt(buoy.transform.position) - before) < 1e-3, "the water at a buoy");
        }
        Check.True(scene.Ocean.Frame.OriginXM == 1200 && scene.Ocean.Frame.OriginZM == 30, "origin");
        Vector3 viewed = viewer.transform.position, moved = buoy.transform.position;
        Check.True(viewed.x == 0 && viewed.y == 3 && viewed.z == 0 && moved.x == -100 && moved.z == 10, "positions");
        Check.Equal(Physics.Synchronised - synchronised, 1, "calls of SyncTransforms()");
        scene.Disable();
    }

    [Test]
    public static void ParticlesAreTheDropletsOfTheFrame()
    {
        UnityEngine.Time.timeAsDouble = 4;
        var scene = new Scene();
        scene.Ocean.SprayAmount = 10;
        scene.Enable();
        BehaviourTests.UpdateUntil(scene.Ocean, () => scene.Ocean.Frame.Droplets.Length > 10, "droplets");
        BehaviourTests.Send(scene.Spray, "LateUpdate");
        var droplets = scene.Ocean.Frame.Droplets;
        Check.Equal(scene.Spray.Particles.Count, droplets.Length, "particles");
        for (var i = 0; i < droplets.Length; ++i)
        {
            var particle = scene.Spray.Particles.Shown[i];
            Check.True(particle.position.x == (float)droplets[i].PositionXM && particle.position.z == -(float)droplets[i].PositionZM && particle.velocity.y == droplets[i].VelocityYMps, "place");
            Check.True(particle.startSize == 2 * droplets[i].RadiusM && particle.remainingLifetime > 0 && particle.remainingLifetime <= particle.startLifetime, "size and age");
        }
        scene.Disable();
    }

    [Test]
    public static void StillWaterIsDrawnAtTheSeaLevelAndMovesWithTheCurrent()
    {
        UnityEngine.Time.timeAsDouble = 4;
        var scenes = new[] { new Scene(), new Scene() };
        scenes[1].Ocean.SeaLevelM = 20;
        scenes[1].Ocean.CurrentMps = new Vector2(1, -2);
        scenes[1].Surface.Camera.transform.position = new Vector3(4 * 1, 23, 4 * -2);
        foreach (var scene in scenes)
        {
            scene.Enable();
            foreach (var component in new MonoBehaviour[] { scene.Ocean, scene.Surface }) BehaviourTests.Send(component, component == scene.Ocean ? "Update" : "LateUpdate");
        }
        // The second viewer moved with the water: it sees the same texels, at the same height above still water.
        Vector4[] still = (Vector4[])scenes[0].Surface.Material["_PelagicCascadePlace"], moved = (Vector4[])scenes[1].Surface.Material["_PelagicCascadePlace"];
        for (var i = 0; i < 4; ++i) Check.True(Math.Abs(still[i].x - moved[i].x) + Math.Abs(still[i].y - moved[i].y) < 1e-5, "place of cascade " + i);
        var viewer = (Vector4)scenes[1].Surface.Material["_PelagicViewer"];
        Check.True(viewer.y == 23 && viewer.w == 20, "heights of viewer and water");
        Check.Equal(scenes[1].Ocean.HeightAt(new Vector3(4 + 30, 0, -8 + 50)), scenes[0].Ocean.HeightAt(new Vector3(30, 0, 50)) + 20, "height of the water");
        foreach (var scene in scenes) scene.Disable();
    }

    [Test]
    public static void PatchesFollowTheFieldsOfASurface()
    {
        UnityEngine.Time.timeAsDouble = 4;
        var scene = new Scene();
        scene.Enable();
        BehaviourTests.Send(scene.Ocean, "Update");
        BehaviourTests.Send(scene.Surface, "LateUpdate");
        var before = scene.Surface.Quadtree.Vertices;
        scene.Surface.PatchVertices = 16;
        BehaviourTests.Send(scene.Surface, "LateUpdate");
        Check.True(before == 32 && scene.Surface.Quadtree.Vertices == 16, "vertices of patches");
        Debug.Errors.Clear();
        var invalid = new (Action, string)[]
        {
            (() => scene.Surface.LodScale = 0, "LodScale is 0, expected a value in [0.75, 8]"), (() => scene.Surface.PatchVertices = 7, "PatchVertices is 7, expected an even number in [2, 128]"),
            (() => scene.Surface.SizeM = 10, "SizeM is 10, expected a value in [256, 8192]"), (() => scene.Surface.Material = null, "Material is none, expected one with the shader Pelagic/Ocean"),
            (() => scene.Surface.Sun = null, "Sun is none, expected a directional light"), (() => scene.Surface.Camera = null, "Camera is none, expected the camera that sees the sea"),
            (() => scene.Surface.Source = null, "Source is none, expected an OceanBehaviour"),
        };
        // Later fields are checked first.
        for (var i = 0; i < invalid.Length; ++i)
        {
            invalid[i].Item1();
            BehaviourTests.Send(scene.Surface, "LateUpdate");
            BehaviourTests.Send(scene.Surface, "LateUpdate");
            Check.Equal(Debug.Errors.LastOrDefault(), "OceanSurface 'Thing': " + invalid[i].Item2, "error");
            Check.Equal(Debug.Errors.Count, i + 1, "errors");
        }
        scene.Disable();
    }

    [Test]
    public static void TheInspectorShowsStatisticsAndProblems()
    {
        UnityEngine.Time.timeAsDouble = 4;
        var behaviour = new OceanBehaviour { Preset = "calm", WaveHeightM = 2, PeakPeriodS = 8, Resolution = 64 };
        var editor = new OceanBehaviourEditor { target = behaviour };
        Func<(string message, MessageType type)> shown = () =>
        {
            EditorGUILayout.Boxes.Clear();
            editor.OnInspectorGUI();
            return EditorGUILayout.Boxes.Last();
        };
        Check.Equal(((CustomEditor)Attribute.GetCustomAttribute(typeof(OceanBehaviourEditor), typeof(CustomEditor))).Inspected, typeof(OceanBehaviour), "inspected type");
        // In edit mode: the sea of the fields, of which 64 texels hold nearly all.
        var words = shown().Item1.Split(' ');
        Check.True(Math.Abs(double.Parse(words[1]) - 2) < 0.05 && Math.Abs(double.Parse(words[4]) - 8) < 0.3 && !shown().Item1.Contains("MB"), shown().Item1);
        BehaviourTests.Send(behaviour, "OnEnable");
        BehaviourTests.Send(behaviour, "Update");
        Check.True(shown().Item1.Contains(" ms of them waiting") && shown().Item1.EndsWith(" MB") && shown().Item2 == MessageType.Info, shown().Item1);
        // 64^2 texels of 4 cascades: two sets of textures of 8 + 4 4/3 + 4 4/3 bytes, 6 snapshots of 4 4/3, and the ocean.
        Check.Equal(behaviour.MemoryBytes, (long)behaviour.Ocean.Info.MemoryBytes + 4096 * 4 * 2 * 56 / 3 + 4096 * 6 * 16 / 3, "bytes");
        Check.True(behaviour.UpdateMs >= behaviour.WaitMs && behaviour.WaitMs >= 0, "times");
        behaviour.Choppiness = 3;
        BehaviourTests.Send(behaviour, "Update");
        shown();
        Check.True(EditorGUILayout.Boxes[0].Item2 == MessageType.Error && EditorGUILayout.Boxes[0].Item1.StartsWith("choppiness 3 is out of range"), "the problem");
        BehaviourTests.Send(behaviour, "OnDisable");
        Check.True(shown().Item2 == MessageType.Error, "a problem in edit mode");
    }
}

/// <summary>In processes whose library is missing or another; the test's driver makes them.</summary>
public static class PluginTests
{
    private static void HasProblem(string expected)
    {
        var behaviour = new OceanBehaviour();
        var surface = new OceanSurface { Source = behaviour, Camera = new Camera(), Sun = new Light(), Material = new Material() };
        var editor = new OceanBehaviourEditor { target = behaviour };
        var floating = new OceanFloating { Ocean = behaviour };
        BehaviourTests.Send(behaviour, "OnValidate");
        BehaviourTests.Send(behaviour, "OnEnable");
        for (var i = 0; i < 3; ++i)
        {
            BehaviourTests.Send(floating, "FixedUpdate");
            BehaviourTests.Send(behaviour, "Update");
            BehaviourTests.Send(surface, "LateUpdate");
            editor.OnInspectorGUI();
        }
        BehaviourTests.Send(behaviour, "OnDisable");
        Check.Equal(string.Join("\n", Debug.Errors), "OceanBehaviour 'Thing': " + expected, "errors");
        Check.Equal(EditorGUILayout.Boxes[0].Item1, expected, "the inspector");
    }

    [Test(IsAlone = true)]
    public static void AMissingPluginIsOneLine()
    {
        HasProblem("pelagic_c was not found, expected in Plugins of the package for this platform; unity/pack.py puts it there");
    }

    [Test(IsAlone = true)]
    public static void AnotherVersionIsOneLine()
    {
        HasProblem("pelagic_c has version 2.0.0, expected 1.0 or a later 1.x");
    }

    [Test(IsAlone = true)]
    public static void AnotherLibraryIsOneLine()
    {
        HasProblem("pelagic_c is no library of Pelagic for this processor");
    }
}
