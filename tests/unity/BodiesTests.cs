using System;
using System.Linq;
using System.Runtime.CompilerServices;
using Pelagic;

public static class BodiesTests
{
    private const double tickS = 1 / 60.0;

    /// <summary>A box of 4 x 1 x 2 m.</summary>
    public static readonly double[] Vertices =
    {
        -2, -0.5, -1, -2, -0.5, 1, -2, 0.5, -1, -2, 0.5, 1, 2, -0.5, -1, 2, -0.5, 1, 2, 0.5, -1, 2, 0.5, 1,
    };
    public static readonly uint[] Triangles =
    {
        0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3,
    };

    private static Ocean Water(Executor executor = null, bool depth = true)
    {
        var waves = DynamicWavesOptions.Default;
        waves.Resolution = 64;
        waves.SideM = 32;
        waves.BorderM = 4;
        return new Ocean(GoldenTests.SmallSea(), new OceanOptions { Queries = true, Depth = depth, DynamicWaves = waves, Executor = executor });
    }

    private static Hull Box() => new Hull(Vertices, Triangles, new HullOptions(2500) { RollDamping = 0.125, CentreOfMassM = new[] { 0, -0.125, 0 } });

    private static void Advance(Ocean ocean, Bodies bodies, int tick)
    {
        ocean.Schedule(tick * tickS);
        ocean.Complete();
        bodies.Press(tickS);
        bodies.Step(tickS);
    }

    private static string Bits(HullState state)
    {
        return Expected.Bits(state.PositionXM, state.PositionYM, state.PositionZM, state.OrientationX, state.OrientationY, state.OrientationZ, state.OrientationW,
                             state.VelocityXMps, state.VelocityYMps, state.VelocityZMps, state.AngularVelocityXRadps, state.AngularVelocityYRadps,
                             state.AngularVelocityZRadps);
    }

    [Test]
    public static void HaveTheGoldenValues()
    {
        using (var ocean = Water())
        using (var bodies = new Bodies(ocean, true))
        {
            uint first, second;
            using (var hull = Box())
            {
                var info = hull.Info;
                Check.Equal(Expected.Bits(info.VolumeM3, info.DraughtM, info.HeightM, info.WaterplaneM2, info.RollGmM, info.PitchGmM), Expected.Text("hull box"), "the hull");
                first = bodies.Add(hull, hull.AtRest(1, -2, 0.25));
                second = bodies.Add(hull, hull.AtRest(-5, 4));
            }
            var inputs = default(HullInputs);
            inputs.Force.ForceXN = 900;
            inputs.WindZMps = 5;
            bodies.SetInputs(second, inputs);
            for (var tick = 0; tick < 40; ++tick) Advance(ocean, bodies, tick);
            Check.Equal(Bits(bodies.State(first)), Expected.Text("body 1"), "the first body");
            Check.Equal(Bits(bodies.State(second)), Expected.Text("body 2"), "the second body");
            var total = bodies.Loads(second).Total;
            Check.Equal(Expected.Bits(total.ForceXN, total.ForceYN, total.ForceZN, total.TorqueXNm, total.TorqueYNm, total.TorqueZNm), Expected.Text("force 2"), "its force");
        }
    }

    [Test]
    public static void ASavedStateIsRestored()
    {
        using (var ocean = Water())
        using (var bodies = new Bodies(ocean, true))
        using (var hull = Box())
        {
            var number = bodies.Add(hull, hull.AtRest(1, -2, 0.3));
            Advance(ocean, bodies, 0);
            var saved = bodies.SaveState();
            bodies.Remove(number);
            bodies.RestoreState(saved);
            Check.True(bodies.SaveState().SequenceEqual(saved), "restored bytes");
            var damaged = (byte[])saved.Clone();
            damaged[50] ^= 1;
            Check.Equal(Check.Throws<PelagicException>(() => bodies.RestoreState(damaged), "a damaged state").Message,
                        "the saved bodies are damaged, expected the bytes that save_state() returned", "message");
            Check.Throws<PelagicException>(() => bodies.RestoreState(default), "no state");
            Check.True(bodies.SaveState().SequenceEqual(saved), "nothing is changed");
        }
    }

    private static float DepthAt(ExactWater water, double x, double y, double z)
    {
        var depth = new float[1];
        water.Sample(new[] { x }, new[] { y }, new[] { z }, new WaterSamples { DepthM = depth });
        return depth[0];
    }

    [Test]
    public static void AreShiftedWithTheOrigin()
    {
        const double toX = 1e7, toZ = -2e6;
        using (var still = Water())
        using (var shifted = Water())
        using (var stillBodies = new Bodies(still, true))
        using (var bodies = new Bodies(shifted, true))
        using (var hull = Box())
        {
            stillBodies.Add(hull, hull.AtRest(1, -2, 0.25));
            var number = bodies.Add(hull, hull.AtRest(1, -2, 0.25));
            for (var tick = 0; tick < 30; ++tick)
            {
                if (tick == 10) shifted.SetOrigin(toX, toZ);
                shifted.Schedule(tick * tickS);
                var frame = shifted.Complete();
                if (tick == 10) bodies.Shift(-toX, -toZ);
                Check.Equal(frame.OriginXM, tick < 10 ? 0 : toX, "origin");
                Check.Equal(frame.OriginZM, tick < 10 ? 0 : toZ, "origin");
                bodies.Press(tickS);
                bodies.Step(tickS);
                Advance(still, stillBodies, tick);
            }
            double difference = Math.Abs(shifted.HeightAt(7 - toX, -3 - toZ) - still.HeightAt(7, -3));
            Check.True(difference <= 1e-5, "the height differs by " + difference + " m");
            HullState expected = stillBodies.State(number), found = bodies.State(number);
            difference = Math.Abs(found.PositionXM + toX - expected.PositionXM) + Math.Abs(found.PositionZM + toZ - expected.PositionZM);
            Check.True(difference <= 1e-6, "the position differs by " + difference + " m");
            Check.Throws<PelagicException>(() => shifted.SetOrigin(2e8, 0), "out of range");
            Check.Throws<PelagicException>(() => bodies.Shift(3e8, 0), "out of range");
        }
        using (var water = new ExactWater(GoldenTests.SmallSea()))
        {
            double x = 3, y = -1, z = 5;
            var before = DepthAt(water, x, y, z);
            water.SetOrigin(toX, toZ);
            Check.True(Math.Abs(DepthAt(water, x - toX, y, z - toZ) - before) <= 1e-5, "the depth of exact water");
        }
    }

    [Test]
    public static void AThousandStepsAllocateNothing()
    {
        using (var executor = new Executor(new ExecutorOptions { Kind = ExecutorKind.Serial }))
        using (var ocean = Water(executor))
        using (var bodies = new Bodies(ocean, true, executor))
        using (var hull = Box())
        {
            var number = bodies.Add(hull, hull.AtRest(0, 0));
            var inputs = default(HullInputs);
            var state = bodies.State(number);
            ocean.Schedule(0);
            ocean.Complete();
            long bytes = 0;
            for (var i = 0; i < 1010; ++i)
            {
                if (i == 10) bytes = GC.GetAllocatedBytesForCurrentThread();
                bodies.SetInputs(number, inputs);
                bodies.Press(tickS);
                bodies.Step(tickS);
                inputs.Force.ForceXN = bodies.State(number).PositionXM;
                bodies.Loads(number);
                hull.ComputeLoads(ocean, ref state, tickS);
                hull.Accelerate(ocean, ref state, tickS, inputs);
            }
            Check.Equal(GC.GetAllocatedBytesForCurrentThread() - bytes, 0L, "bytes of 1,000 steps");
        }
    }

    [Test]
    public static void InvalidArgumentsThrow()
    {
        using (var ocean = Water())
        using (var bodies = new Bodies(ocean))
        using (var hull = Box())
        {
            var message = Check.Throws<PelagicException>(() => new Hull(Vertices, Triangles.Skip(3).ToArray(), new HullOptions(9)), "an open mesh").Message;
            Check.True(message.StartsWith("the hull is open at the edge between vertices "), message);
            Check.Throws<PelagicException>(() => new Hull(default, default, new HullOptions(9)), "no mesh");
            Check.Throws<PelagicException>(() => new Hull(Vertices, Triangles, new HullOptions(double.NaN)), "no mass");
            Check.Throws<ArgumentException>(() => new Hull(new double[4], Triangles, new HullOptions(9)), "four numbers");
            Check.Throws<ArgumentException>(() => new Hull(Vertices, Triangles, new HullOptions(9) { AddedMass = new double[6] }), "six of 36 numbers");
            Check.Throws<ArgumentNullException>(() => new Bodies(null), "no ocean");
            Check.Throws<ArgumentNullException>(() => bodies.Add(null, default), "no hull");
            Check.Throws<PelagicException>(() => bodies.Add(hull, default), "no orientation");
            Check.Throws<PelagicException>(() => bodies.State(3), "an unknown body");
            Check.Equal(Check.Throws<PelagicException>(() => bodies.Step(tickS), "no frame").Status, Status.WrongOrder, "status");
            var state = hull.AtRest(0, 0);
            Check.Throws<PelagicException>(() => hull.ComputeLoads(ocean, ref state, 1), "a step of a second");
        }
        using (var ocean = Water(depth: false))
            Check.Equal(Check.Throws<PelagicException>(() => new Bodies(ocean), "no depth").Message,
                        "bodies need queries and depth, which the ocean was created without", "message");
    }

    [Test]
    public static void OceanAndBodiesAreDisposedInAnyOrder()
    {
        var ocean = Water();
        var bodies = new Bodies(ocean, true);
        using (var hull = Box()) bodies.Add(hull, hull.AtRest(0, 0));
        Advance(ocean, bodies, 0);
        ocean.Dispose();
        Check.Throws<ObjectDisposedException>(() => bodies.Step(tickS), "bodies of a disposed ocean");
        bodies.Dispose();
        bodies.Dispose();
        using (ocean = Water())
        {
            Forgotten(ocean);
            GC.Collect();
            GC.WaitForPendingFinalizers();
            ocean.Schedule(tickS);
            ocean.Complete();
        }
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private static void Forgotten(Ocean ocean)
    {
        using (var hull = Box()) new Bodies(ocean, true).Add(hull, hull.AtRest(0, 0));
        ocean.Schedule(0);
        ocean.Complete();
    }

    [Test]
    public static void StepsRunOnJobsOfTheApplication()
    {
        using (var jobs = new ThreadJobs(2))
        using (var executor = new Executor(jobs, 2))
        using (var ocean = Water())
        using (var bodies = new Bodies(ocean, false, executor))
        using (var hull = Box())
        {
            var number = bodies.Add(hull, hull.AtRest(0, 0));
            ocean.Schedule(0);
            ocean.Complete();
            bodies.Step(tickS);
            using (var serial = new Bodies(ocean))
            {
                var other = serial.Add(hull, hull.AtRest(0, 0));
                serial.Step(tickS);
                Check.Equal(Bits(bodies.State(number)), Bits(serial.State(other)), "the state");
            }
        }
    }
}
