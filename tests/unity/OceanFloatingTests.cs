using System;
using System.Linq;
using Pelagic;
using Pelagic.Unity;
using UnityEngine;

public static class OceanFloatingTests
{
    private const float massKg = 2500, timeStepS = 0.02f;

    /// <summary>The box of BodiesTests, away from the origin, in the hull's axes.</summary>
    private static double[] HullVertices() => BodiesTests.Vertices.Select((value, i) => value + new[] { 0.75, 0.25, 0.125 }[i % 3]).ToArray();

    public static Mesh Mesh()
    {
        var vertices = HullVertices();
        var mesh = new Mesh { vertices = new Vector3[vertices.Length / 3], triangles = BodiesTests.Triangles.Reverse().Select(number => (int)number).ToArray() };
        for (var i = 0; i < mesh.vertices.Length; ++i)
            mesh.vertices[i] = new Vector3((float)vertices[3 * i + 2], (float)vertices[3 * i + 1], (float)vertices[3 * i]);
        return mesh;
    }

    /// <summary>A vertex of the hull in the sea's axes.</summary>
    private static double[] Placed(HullState state, HullInfo info, double[] vertices, int vertex)
    {
        double[] q = { state.OrientationX, state.OrientationY, state.OrientationZ };
        double[] v = { vertices[3 * vertex] - info.CentreOfMassXM, vertices[3 * vertex + 1] - info.CentreOfMassYM, vertices[3 * vertex + 2] - info.CentreOfMassZM };
        Func<double[], double[], double[]> cross = (a, b) => new[] { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
        double[] t = cross(q, v).Select(x => 2 * x).ToArray(), u = cross(q, t);
        double[] position = { state.PositionXM, state.PositionYM, state.PositionZM };
        return Enumerable.Range(0, 3).Select(i => position[i] + v[i] + state.OrientationW * t[i] + u[i]).ToArray();
    }

    [Test]
    public static void ATransformFollowsTheHullOfTheCInterface()
    {
        var behaviour = new OceanBehaviour { Preset = "storm", Resolution = 32, Foam = false, Depth = true };
        var floating = new OceanFloating { Ocean = behaviour, Mesh = Mesh(), MassKg = massKg, Force = new Vector3(1000, 0, 500) };
        floating.transform.position = new Vector3(3, 0, 4);
        floating.transform.forward = new Vector3(0.6f, 0, 0.8f);
        UnityEngine.Time.timeAsDouble = 2;
        UnityEngine.Time.fixedDeltaTime = timeStepS;
        BehaviourTests.Send(floating, "FixedUpdate");  // before the ocean: no step
        BehaviourTests.Send(behaviour, "OnEnable");
        BehaviourTests.Send(behaviour, "Update");
        using (var hull = new Hull(HullVertices(), BodiesTests.Triangles, new HullOptions(massKg)))
        using (var bodies = new Bodies(behaviour.Ocean))
        {
            // The sea's z is mirrored: a bow towards +z of the scene points towards -z of the sea.
            var heading = -Math.Atan2(0.8f, 0.6f);
            var rest = hull.AtRest(0, 0, heading);
            var origin = Placed(new HullState { OrientationY = rest.OrientationY, OrientationW = rest.OrientationW }, hull.Info, new double[3], 0);
            var number = bodies.Add(hull, hull.AtRest(3 - origin[0], -4 - origin[2], heading));
            bodies.SetInputs(number, new HullInputs { Force = new HullForce { ForceXN = 1000, ForceZN = -500 } });
            for (var step = 0; step < 200; ++step)
            {
                if (step % 2 == 1)
                {
                    UnityEngine.Time.timeAsDouble += 0.04;
                    BehaviourTests.Send(behaviour, "Update");
                }
                BehaviourTests.Send(floating, "FixedUpdate");
                bodies.Step(timeStepS);
                var state = bodies.State(number);
                // The positions of the launch differ by rounding.
                Check.True(Math.Abs(state.PositionXM - floating.State.PositionXM) < 1e-9 && Math.Abs(state.PositionZM - floating.State.PositionZM) < 1e-9, "position");
                var vertices = HullVertices();
                for (var i = 0; i < floating.Mesh.vertices.Length; ++i)
                {
                    var expected = Placed(state, hull.Info, vertices, i);
                    var turned = floating.transform.rotation * floating.Mesh.vertices[i];
                    var place = floating.transform.position;
                    // Floats of a few metres: rounding of some 1e-6.
                    Check.True(Math.Abs(place.x + turned.x - expected[0]) < 1e-5 && Math.Abs(place.y + turned.y - expected[1]) < 1e-5 &&
                                   Math.Abs(-(place.z + turned.z) - expected[2]) < 1e-5,
                               "a vertex of the mesh");
                }
            }
            Check.True(Math.Abs(floating.State.OrientationX) + Math.Abs(floating.State.OrientationZ) > 1e-3, "the waves rock the hull");
        }
        BehaviourTests.Send(floating, "OnDisable");
        BehaviourTests.Send(behaviour, "OnDisable");
    }

    /// <summary>Plays frames of a display, and steps of timeStepS between them.</summary>
    private static void Play(OceanBehaviour behaviour, OceanFloating floating, double seconds, double frameS, Action<double> eachFrame = null)
    {
        double playedS = 0, steppedS = 0;
        while (playedS < seconds)
        {
            playedS += frameS;
            UnityEngine.Time.timeAsDouble += frameS;
            for (; steppedS + timeStepS <= playedS; steppedS += timeStepS) BehaviourTests.Send(floating, "FixedUpdate");
            BehaviourTests.Send(behaviour, "Update");
            eachFrame?.Invoke(playedS);
        }
    }

    [Test]
    public static void AHullKeepsItsPlaceWhenTheOriginIsShifted()
    {
        const double toX = 4096, toZ = -1024;
        var places = new double[2, 2];
        for (var shifts = 0; shifts < 2; ++shifts)
        {
            UnityEngine.Time.timeAsDouble = 2;
            UnityEngine.Time.fixedDeltaTime = timeStepS;
            var behaviour = new OceanBehaviour { Preset = "storm", Resolution = 32, Foam = false, Depth = true, DynamicWaves = true };
            var floating = new OceanFloating { Ocean = behaviour, Mesh = Mesh(), MassKg = massKg, Force = new Vector3(1000, 0, 500) };
            BehaviourTests.Send(behaviour, "OnEnable");
            Play(behaviour, floating, 0.5, 0.02);
            if (shifts == 1) behaviour.SetOrigin(toX, toZ);
            Play(behaviour, floating, 0.5, 0.02);
            places[shifts, 0] = floating.State.PositionXM + shifts * toX;
            places[shifts, 1] = floating.State.PositionZM + shifts * toZ;
            BehaviourTests.Send(floating, "OnDisable");
            BehaviourTests.Send(behaviour, "OnDisable");
        }
        for (var axis = 0; axis < 2; ++axis) Check.True(Math.Abs(places[1, axis] - places[0, axis]) < 1e-6, "place");
    }

    /// <summary>Height of the dynamic waves at the texel of a position.</summary>
    private static float WavesAt(OceanBehaviour behaviour, Vector3 position)
    {
        var view = behaviour.Frame.DynamicWaves;
        Func<double, int> texel = atM => (int)((long)Math.Round(atM / view.TexelM) & (view.Resolution - 1));
        return view.HeightM[texel(-position.z) * view.Resolution + texel(position.x)];
    }

    /// <summary>A box of 4 x 1 x 2 m on smooth water, at rest in the hollow that its wake's pressure makes.</summary>
    [Test]
    public static void AHullMakesAWakeInDynamicWaves()
    {
        const double draughtM = 2500 / 1025.0 / 8;
        UnityEngine.Time.fixedDeltaTime = timeStepS;
        foreach (var frameS in new[] { 1 / 50.0, 1 / 144.0, 1 / 7.0 })
        {
            UnityEngine.Time.timeAsDouble = 0;
            var behaviour = new OceanBehaviour { Preset = "beaufort-0", Resolution = 32, Foam = false, Depth = true, DynamicWaves = true };
            var floating = new OceanFloating { Ocean = behaviour, Mesh = Mesh(), MassKg = massKg };
            floating.transform.forward = new Vector3(0, 0, 1);
            BehaviourTests.Send(behaviour, "OnEnable");
            BehaviourTests.Send(behaviour, "Update");
            double sumM = 0;
            var count = 0;
            Play(behaviour, floating, 30, frameS, playedS =>
            {
                if (playedS < 15) return;
                sumM += WavesAt(behaviour, floating.transform.position);
                ++count;
            });
            Check.True(Math.Abs(sumM / count + draughtM) < 0.05 * draughtM, "a hollow of " + sumM / count);
            BehaviourTests.Send(floating, "OnDisable");
            BehaviourTests.Send(floating, "OnDisable");
            for (var frame = 0; frame < 12 / frameS; ++frame)
            {
                UnityEngine.Time.timeAsDouble += frameS;
                BehaviourTests.Send(behaviour, "Update");
            }
            var afterM = WavesAt(behaviour, floating.transform.position);
            Check.True(Math.Abs(afterM) < 0.1 * draughtM, "no hollow without the hull: " + afterM);
            // The ocean ends first.
            Play(behaviour, floating, 1, frameS);
            BehaviourTests.Send(behaviour, "OnDisable");
            BehaviourTests.Send(floating, "FixedUpdate");
            BehaviourTests.Send(behaviour, "OnEnable");
            Play(behaviour, floating, 1, frameS);
            BehaviourTests.Send(behaviour, "OnDisable");
            BehaviourTests.Send(floating, "OnDisable");
        }
    }

    [Test]
    public static void AHullIsLaunchedAgainInANewOcean()
    {
        var behaviour = new OceanBehaviour { Preset = "calm", Resolution = 32, Foam = false, Depth = true };
        var floating = new OceanFloating { Ocean = behaviour, Mesh = Mesh(), MassKg = massKg };
        floating.transform.forward = new Vector3(1, 0, 0);
        for (var round = 0; round < 2; ++round)
        {
            BehaviourTests.Send(behaviour, "OnEnable");
            BehaviourTests.Send(behaviour, "Update");
            BehaviourTests.Send(floating, "FixedUpdate");
            Check.True(floating.State.OrientationW != 0, "a step");
            BehaviourTests.Send(behaviour, "OnDisable");
            BehaviourTests.Send(floating, "FixedUpdate");
        }
        BehaviourTests.Send(floating, "OnDisable");
    }

    /// <summary>A hull whose forces move a rigid body moves as one that the library integrates, in the same frames.</summary>
    [Test]
    public static void ABodyMovesAsTheHullAlone()
    {
        UnityEngine.Time.timeAsDouble = 2;
        UnityEngine.Time.fixedDeltaTime = timeStepS;
        var behaviour = new OceanBehaviour { Preset = "storm", Resolution = 32, Foam = false, Depth = true };
        BehaviourTests.Send(behaviour, "OnEnable");
        BehaviourTests.Send(behaviour, "Update");
        float restM;
        using (var hull = new Hull(HullVertices(), BodiesTests.Triangles, new HullOptions(massKg))) restM = (float)(hull.AtRest(0, 0).PositionYM - hull.Info.CentreOfMassYM);
        var body = new Rigidbody { position = new Vector3(3, restM, 4), rotation = Quaternion.LookRotation(new Vector3(0.6f, 0, 0.8f), new Vector3(0, 1, 0)) };
        var alone = new OceanFloating { Ocean = behaviour, Mesh = Mesh(), MassKg = massKg, Force = new Vector3(1000, 0, 500) };
        var forced = new OceanFloating { Ocean = behaviour, Mesh = Mesh(), MassKg = massKg, Force = new Vector3(1000, 0, 500), Body = body };
        foreach (var floating in new[] { alone, forced })
        {
            floating.transform.position = new Vector3(3, 0, 4);
            floating.transform.forward = new Vector3(0.6f, 0, 0.8f);
        }
        foreach (var usesGravity in new[] { true, false })
        {
            body.useGravity = usesGravity;
            for (var step = 0; step < 100; ++step)
            {
                UnityEngine.Time.timeAsDouble += timeStepS;
                BehaviourTests.Send(behaviour, "Update");
                UnityEngine.Time.fixedTimeAsDouble = behaviour.Frame.TimeS;
                BehaviourTests.Send(alone, "FixedUpdate");
                BehaviourTests.Send(forced, "FixedUpdate");
                body.Simulate(timeStepS);
                Vector3 found = body.position, expected = alone.transform.position, bow = body.rotation * new Vector3(0, 0, 1), other = alone.transform.rotation * new Vector3(0, 0, 1);
                Vector3 away = found - expected, turned = bow - other;
                // A step of physics moves the body by the velocity at its end, that of the library by the mean: and a step may decide about a slam at 5 m/s.
                Check.True(Length(away) < 5 * timeStepS && Length(turned) < 0.02, $"step {step}: {Length(away)} m, {Length(turned)}");
            }
        }
        Check.Equal(body.mass, massKg, "mass");
        BehaviourTests.Send(alone, "OnDisable");
        BehaviourTests.Send(forced, "OnDisable");
        BehaviourTests.Send(behaviour, "OnDisable");
    }

    private static double Length(Vector3 v) => Math.Sqrt(v.x * v.x + v.y * v.y + v.z * v.z);

    /// <summary>Heights of a body in a swell at its steps. frameS: time between frames; 0: a frame at the time of each step.</summary>
    private static double[] HeightsOfABody(double frameS)
    {
        UnityEngine.Time.timeAsDouble = 0;
        UnityEngine.Time.fixedDeltaTime = timeStepS;
        var behaviour = new OceanBehaviour
        {
            Preset = "calm", WindSpeedMps = 1, Resolution = 64, Foam = false, Depth = true, Threads = 1, Systems = new[] { new OceanSystem { HeightM = 1.5f, PeriodS = 8, TowardsDeg = 90 } },
        };
        var body = new Rigidbody();
        var floating = new OceanFloating { Ocean = behaviour, Mesh = Mesh(), MassKg = massKg, Body = body };
        floating.transform.forward = new Vector3(0, 0, 1);
        BehaviourTests.Send(behaviour, "OnEnable");
        var heights = new double[800];
        double shownS = 0;
        for (var i = 0; i < heights.Length; ++i)
        {
            var nowS = (i + 1) * (double)timeStepS;
            UnityEngine.Time.fixedTimeAsDouble = nowS;
            if (frameS == 0)
                for (var update = 0; update < 2; ++update)
                {
                    UnityEngine.Time.timeAsDouble = nowS;
                    BehaviourTests.Send(behaviour, "Update");
                }
            for (; frameS > 0 && shownS + frameS < nowS; shownS += frameS)
            {
                UnityEngine.Time.timeAsDouble = shownS + frameS;
                BehaviourTests.Send(behaviour, "Update");
            }
            BehaviourTests.Send(floating, "FixedUpdate");
            body.Simulate(timeStepS);
            heights[i] = body.position.y;
            body.position = new Vector3(0, body.position.y, 0);  // moored: waves of other times let it drift otherwise
        }
        BehaviourTests.Send(floating, "OnDisable");
        BehaviourTests.Send(behaviour, "OnDisable");
        return heights;
    }

    [Test]
    public static void ABodyFloatsInTheWaterOfItsTime()
    {
        var expected = HeightsOfABody(0);
        // In the water of its frame, one to two frames old, the body is off by up to 0.6 m/s times that: 17.6 mm at 72 frames a second.
        foreach (var entry in new (double frameS, double boundM)[] { (1 / 72.0, 0.008), (1 / 144.0, 0.004) })
        {
            var heights = HeightsOfABody(entry.Item1);
            double worst = 0;
            for (var i = 300; i < heights.Length; ++i) worst = Math.Max(worst, Math.Abs(heights[i] - expected[i]));
            Check.True(worst < entry.Item2, $"{worst} m at {1 / entry.Item1} frames a second");
        }
    }

    /// <summary>A frame 0.3 of a step after a step shows 0.3 of the way from the step before, also where the origin has shifted.</summary>
    [Test]
    public static void AHullAloneIsShownBetweenItsSteps()
    {
        UnityEngine.Time.timeAsDouble = 2;
        UnityEngine.Time.fixedDeltaTime = timeStepS;
        var behaviour = new OceanBehaviour { Preset = "storm", Resolution = 32, Foam = false, Depth = true };
        var floating = new OceanFloating { Ocean = behaviour, Mesh = Mesh(), MassKg = massKg };
        floating.transform.forward = new Vector3(0, 0, 1);
        BehaviourTests.Send(behaviour, "OnEnable");
        BehaviourTests.Send(behaviour, "Update");
        var places = new Vector3[3];
        var bows = new Vector3[3];
        for (var i = 0; i < 20; ++i)
        {
            BehaviourTests.Send(floating, "FixedUpdate");
            places[0] = places[1];
            bows[0] = bows[1];
            places[1] = floating.transform.position;
            bows[1] = floating.transform.rotation * new Vector3(0, 0, 1);
        }
        UnityEngine.Time.fixedTimeAsDouble = 2;
        UnityEngine.Time.timeAsDouble = 2 + 0.3 * timeStepS;
        foreach (var toXM in new[] { 0, 1000 })
        {
            behaviour.SetOrigin(toXM, 0);
            for (var i = 0; i < 2; ++i) BehaviourTests.Send(behaviour, "Update");
            BehaviourTests.Send(floating, "Update");
            places[2] = floating.transform.position;
            bows[2] = floating.transform.rotation * new Vector3(0, 0, 1);
            Vector3 away = places[2] - places[0] - (places[1] - places[0]) * 0.3f, turned = bows[2] - bows[0] - (bows[1] - bows[0]) * 0.3f;
            Check.True(Length(away + new Vector3(toXM, 0, 0)) < 1e-4 && Length(turned) < 1e-4 && Length(places[1] - places[0]) > 0.01, $"{Length(away)} m");
        }
        BehaviourTests.Send(floating, "OnDisable");
        BehaviourTests.Send(behaviour, "OnDisable");
    }

    /// <summary>Unity's cube of 1 m, whose faces share no vertices, as in the sample's prefab; wound clockwise as seen from outside, in left-handed axes.</summary>
    private static Mesh Cube()
    {
        var mesh = new Mesh { vertices = new Vector3[24], triangles = new int[36] };
        for (var face = 0; face < 6; ++face)
        {
            var sign = face % 2 == 0 ? 1 : -1;
            for (var i = 0; i < 4; ++i)
            {
                var at = new float[3];
                at[face / 2] = sign * 0.5f;
                at[(face / 2 + 1) % 3] = (i == 1 || i == 2 ? 0.5f : -0.5f) * sign;
                at[(face / 2 + 2) % 3] = i < 2 ? -0.5f : 0.5f;
                mesh.vertices[4 * face + i] = new Vector3(at[0], at[1], at[2]);
            }
            new[] { 0, 1, 2, 0, 2, 3 }.Select(i => 4 * face + i).ToArray().CopyTo(mesh.triangles, 6 * face);
        }
        return mesh;
    }

    [Test]
    public static void TheSamplesCubeFloatsUpright()
    {
        UnityEngine.Time.timeAsDouble = 0;
        UnityEngine.Time.fixedDeltaTime = timeStepS;
        var behaviour = new OceanBehaviour { Preset = "beaufort-0", Resolution = 32, Foam = false, Depth = true, Threads = 1 };
        // Dropped with an inclination of 11 degrees.
        var body = new Rigidbody { position = new Vector3(0, 1, 0), rotation = Quaternion.AngleAxis(11, new Vector3(1, 0, 0)) };
        var floating = new OceanFloating { Ocean = behaviour, Mesh = Cube(), MassKg = 150, Body = body };
        floating.transform.forward = new Vector3(0, 0, 1);
        BehaviourTests.Send(behaviour, "OnEnable");
        for (var i = 0; i < 1000; ++i)
        {
            UnityEngine.Time.timeAsDouble = UnityEngine.Time.fixedTimeAsDouble = i * timeStepS;
            BehaviourTests.Send(behaviour, "Update");
            BehaviourTests.Send(floating, "FixedUpdate");
            body.Simulate(timeStepS);
        }
        // Archimedes: 150 kg displace 0.146 m of 1 m^2. GM is 0.29 m.
        Check.True(floating.Problem == null && Math.Abs(body.position.y - (0.5 - 150 / 1025.0)) < 0.01, $"{floating.Problem} {body.position.y} m");
        Check.True((body.rotation * new Vector3(0, 1, 0)).y > 0.999, "upright");
        BehaviourTests.Send(floating, "OnDisable");
        BehaviourTests.Send(behaviour, "OnDisable");
    }

    [Test]
    public static void AHullThatCannotFloatIsOneLine()
    {
        UnityEngine.Time.timeAsDouble = 0;
        var open = Mesh();
        open.triangles = open.triangles.Skip(3).ToArray();
        var locked = Mesh();
        locked.isReadable = false;
        foreach (var entry in new (Mesh, float, bool, string)[]
        {
            (null, massKg, true, "Mesh is none, expected the outer surface of a hull"),
            (locked, massKg, true, "Mesh 'Thing' is not readable, expected Read/Write enabled in its import settings"),
            (open, massKg, true, ""),
            (Mesh(), 0f, true, "mass_kg 0 is out of range"),
            (Mesh(), massKg, false, "OceanBehaviour 'Thing' has no Depth, which a hull needs"),
        })
        {
            var behaviour = new OceanBehaviour { Preset = "calm", Resolution = 32, Foam = false, Depth = entry.Item3 };
            var floating = new OceanFloating { Ocean = behaviour, Mesh = entry.Item1, MassKg = entry.Item2 };
            floating.transform.forward = new Vector3(0, 0, 1);
            BehaviourTests.Send(behaviour, "OnEnable");
            BehaviourTests.Send(behaviour, "Update");
            Debug.Errors.Clear();
            for (var i = 0; i < 3; ++i) BehaviourTests.Send(floating, "FixedUpdate");
            Check.True(Debug.Errors.Count == 1 && !Debug.Errors[0].Contains("\n") && Debug.Errors[0].StartsWith("OceanFloating 'Thing': " + entry.Item4), string.Join("\n", Debug.Errors));
            floating.Mesh = Mesh();
            floating.MassKg = massKg;
            behaviour.Depth = true;
            BehaviourTests.Send(behaviour, "Update");
            BehaviourTests.Send(floating, "FixedUpdate");
            Check.True(floating.Problem == null && floating.State.OrientationW != 0, "a step");
            BehaviourTests.Send(floating, "OnDisable");
            BehaviourTests.Send(behaviour, "OnDisable");
        }
    }
}
