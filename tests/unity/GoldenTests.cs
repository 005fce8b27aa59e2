using System;
using System.Collections.Generic;
using System.Linq;
using Pelagic;

public static unsafe class GoldenTests
{
    private static Sea Of(Action<Box> change)
    {
        var box = new Box { Sea = Sea.Default };
        change(box);
        return box.Sea;
    }

    public sealed class Box
    {
        public Sea Sea;
    }

    private static Sea OneCascade(Action<Box> change = null)
    {
        return Of(box =>
        {
            box.Sea.Resolution = 64;
            box.Sea.PatchSizeM = 250;
            change?.Invoke(box);
        });
    }

    /// <summary>The seas of tests/golden/hashes.txt.</summary>
    public static Dictionary<string, Sea> Seas()
    {
        var seas = new Dictionary<string, Sea>
        {
            ["default"] = Sea.Default,
            ["phillips-paper-64"] = OneCascade(box => box.Sea.Spectrum = Spectrum.PhillipsPaper),
            ["phillips-64"] = OneCascade(box => box.Sea.Spectrum = Spectrum.Phillips),
            ["pierson-moskowitz-64"] = OneCascade(box => box.Sea.Spectrum = Spectrum.PiersonMoskowitz),
            ["jonswap-64"] = OneCascade(),
            ["spreading-cosine-2s-64"] = OneCascade(box => box.Sea.Spreading = Spreading.Cosine2s),
            ["spreading-hasselmann-64"] = OneCascade(box => box.Sea.Spreading = Spreading.Hasselmann),
            ["spreading-paper-64"] = OneCascade(box => box.Sea.Spreading = Spreading.Paper),
            ["shallow-64"] = OneCascade(box => box.Sea.DepthM = 8),
            ["breaking-swell-64"] = OneCascade(box =>
            {
                box.Sea.DepthM = 2;
                box.Sea.SwellHeightM = 1;
                box.Sea.SwellDirectionRad = 2;
            }),
            ["analytic-64"] = Of(box =>
            {
                box.Sea.Waves = WavesKind.Analytic;
                box.Sea.Resolution = 64;
                box.Sea.Choppiness = 1;
            }),
            ["pond-64"] = Of(box =>
            {
                box.Sea.Waves = WavesKind.Pond;
                box.Sea.Resolution = 64;
            }),
            ["none-64"] = OneCascade(box =>
            {
                box.Sea.Spectrum = Spectrum.None;
                box.Sea.SwellHeightM = 2;
            }),
            ["wind-sea-by-height"] = Of(box =>
            {
                box.Sea.WaveHeightM = 2;
                box.Sea.PeakPeriodS = 7;
            }),
            ["short-wave-cutoff-64"] = OneCascade(box => box.Sea.ShortWaveCutoff = 0.8),
        };
        foreach (var preset in new[] { "calm", "moderate", "rough", "storm" }) seas["preset-" + preset] = Sea.Preset(preset);
        return seas;
    }

    public static Frame FrameAt(Ocean ocean, double time)
    {
        ocean.Schedule(time);
        return ocean.Complete();
    }

    private static void CompareFrames(Func<OceanOptions> options)
    {
        foreach (var sea in Seas())
            using (var ocean = new Ocean(sea.Value, options()))
                foreach (var time in new[] { "0", "12.34" })
                {
                    FrameAt(ocean, double.Parse(time));
                    Check.Equal(ocean.Hash(), Expected.Hash($"golden {sea.Key}@{time}"), $"{sea.Key}@{time}");
                }
    }

    [Test]
    public static void FramesHaveTheGoldenHashes()
    {
        CompareFrames(() => null);
    }

    [Test]
    public static void FramesOfAJobSystemOfManagedThreadsHaveTheGoldenHashes()
    {
        using (var jobs = new ThreadJobs(3))
        using (var executor = new Executor(jobs, 3))
        {
            CompareFrames(() => new OceanOptions { Executor = executor });
            Check.True(jobs.JobCount > 1000, "managed threads ran the jobs");
        }
    }

    [Test]
    public static void FoamHasTheGoldenHash()
    {
        var sea = Sea.Default;
        sea.Cascades = 4;
        sea.Resolution = 64;
        sea.Choppiness = 1;
        using (var ocean = new Ocean(sea, new OceanOptions { Foam = true }))
        {
            FrameAt(ocean, 12.34);
            Check.Equal(ocean.FoamHash(), Expected.Hash("golden foam-cascades"), "foam");
        }
    }

    /// <summary>FNV-1a of the bits of planes by texel.</summary>
    private static ulong HashOf(Frame frame, Func<Cascade, Plane[]> planes)
    {
        var hash = 0xcbf29ce484222325UL;
        for (var c = 0; c < frame.CascadeCount; ++c)
            foreach (var plane in planes(frame.Cascade(c)))
                for (var j = 0; j < plane.Resolution; ++j)
                    for (var i = 0; i < plane.Resolution; ++i)
                    {
                        var texel = plane[i, j];
                        hash = (hash ^ *(uint*)&texel) * 0x100000001b3UL;
                    }
        return hash;
    }

    [Test]
    public static void TexelsOfPlanesHaveTheGoldenHashes()
    {
        foreach (var name in new[] { "jonswap-64", "none-64", "phillips-64", "phillips-paper-64", "pierson-moskowitz-64" })
        {
            var sea = Seas()[name];
            sea.Roughness = 0.1;
            sea.Spreading = Spreading.Paper;
            sea.Lean = 0;
            sea.LoopPeriodS = 200;
            using (var ocean = new Ocean(sea))
                foreach (var time in new[] { "0", "12.34" })
                {
                    var found = HashOf(FrameAt(ocean, double.Parse(time)), cascade => new[] { cascade.Dx, cascade.Height, cascade.Dz });
                    Check.Equal(found, Expected.Hash($"displacement {name}@{time}"), $"displacement {name}@{time}");
                }
        }
    }

    /// <summary>The sea, the shore and the points of tests/golden_values_test.cpp.</summary>
    public static Sea SmallSea()
    {
        return Of(box =>
        {
            box.Sea.Cascades = 3;
            box.Sea.Resolution = 32;
            box.Sea.WindSpeedMps = 8;
            box.Sea.LoopPeriodS = 40;
        });
    }

    private static ShoreOptions Bay()
    {
        var shore = new ShoreOptions { Columns = 81, Rows = 61, MetresPerSample = 5, CornerXM = -170, CornerZM = -130, Resolution = 64 };
        shore.HeightsM = new float[81 * 61];
        for (var j = 0; j < 61; ++j)
            for (var i = 0; i < 81; ++i)
            {
                double x = 5 * i, fromX = x - 150, fromZ = 5 * j - 120, squared = (fromX * fromX + fromZ * fromZ) / 1600;
                shore.HeightsM[j * 81 + i] = (float)(-12 + x * 0.035 + 16 / (1 + squared * squared));
            }
        return shore;
    }

    private static readonly double[] pointsX = { 1.5, -7.25, 12, 3, 60, 150.5, -60, 400 }, pointsZ = { 0.25, 4, -9.75, -2, 40.5, 10, 100, -1000 };

    [Test]
    public static void AShoreHasTheGoldenHashes()
    {
        using (var ocean = new Ocean(SmallSea(), new OceanOptions { Shore = Bay(), Queries = true }))
            foreach (var time in new[] { "0", "7.3" })
            {
                var surface = FrameAt(ocean, double.Parse(time)).Shoreline;
                Check.Equal(ocean.ShoreHash(), Expected.Hash("shore " + time), "shore " + time);
                Check.Equal(surface.HeightM.Length, surface.Columns * surface.Rows, "texels");
                float lowest = 0, highest = 0;
                foreach (var height in surface.HeightM)
                {
                    lowest = Math.Min(lowest, height);
                    highest = Math.Max(highest, height);
                }
                Check.True(lowest >= surface.HeightMinM && highest <= surface.HeightMaxM && highest > 0.01, "heights are within their bounds");
            }
    }

    [Test]
    public static void ExactWaterHasTheGoldenValues()
    {
        double[] y = { -1.5, -0.25, -20, 0, 1, -3, -100, -4000 };
        var of = new float[8][];
        for (var i = 0; i < of.Length; ++i) of[i] = new float[y.Length];
        var height = new float[y.Length];
        using (var water = new ExactWater(SmallSea()))
        {
            water.SetTime(12.5);
            var samples = new WaterSamples
            {
                DepthM = of[0],
                PressurePa = of[1],
                VelocityXMps = of[2],
                VelocityYMps = of[3],
                VelocityZMps = of[4],
                AccelerationXMps2 = of[5],
                AccelerationYMps2 = of[6],
                AccelerationZMps2 = of[7],
            };
            water.Sample(pointsX, y, pointsZ, samples);
            water.SampleHeights(pointsX, pointsZ, height);
            for (var i = 0; i < y.Length; ++i)
            {
                Check.Equal(Expected.Bits(of[0][i], of[1][i], of[2][i], of[3][i], of[4][i], of[5][i], of[6][i], of[7][i]),
                            Expected.Text($"exact {i}"), $"exact {i}");
                Check.Equal(Expected.Bits(height[i]), Expected.Text($"exact-surface {i}").Split(',')[0], $"exact-surface {i}");
            }
        }
        using (var executor = new Executor(new ExecutorOptions { Threads = 2 }))
        using (var lifted = new ExactWater(SmallSea(), new ExactWaterOptions { WaterFrame = new WaterFrame { SeaLevelM = 2 }, Executor = executor }))
        {
            lifted.SetTime(12.5);
            var raised = new float[y.Length];
            lifted.SampleHeights(pointsX, pointsZ, raised);
            for (var i = 0; i < y.Length; ++i) Check.True(Math.Abs(raised[i] - height[i] - 2) < 1e-6, "the sea level lifts the surface");
            Check.Equal(Check.Throws<PelagicException>(() => lifted.Sample(new double[1], new[] { -3999.0 }, new double[1], new WaterSamples()),
                                                       "a point below the floor").Message,
                        "y[0] is -3999, expected at least -3998, the sea floor", "a point below the floor");
        }
    }

    [Test]
    public static void WaterOfAFrameIsBelowItsSurface()
    {
        double[] y = { -1.5, -0.25, -20, 0, 1, -3, -100, -3990 };
        float[] depth = new float[y.Length], pressure = new float[y.Length], rise = new float[y.Length], height = new float[y.Length];
        using (var ocean = new Ocean(SmallSea(), new OceanOptions { Queries = true, Depth = true }))
        {
            Check.Equal(Check.Throws<PelagicException>(() => ocean.SampleWater(pointsX, y, pointsZ, default), "no frame").Status, Status.WrongOrder, "status");
            ocean.Schedule(12.5);
            ocean.Complete();
            ocean.SampleWater(pointsX, y, pointsZ, new WaterSamples { DepthM = depth, PressurePa = pressure, AccelerationYMps2 = rise });
            ocean.Query(pointsX, pointsZ, new Samples { HeightM = height });
            for (var i = 0; i < y.Length; ++i)
            {
                Check.True(Math.Abs(height[i] - y[i] - depth[i]) < 1e-3, $"depth {i}");
                Check.Equal(pressure[i] > 0, depth[i] > 0, $"pressure {i}");
            }
            Check.True(Math.Abs(pressure[7] / (1025 * 9.80665 * 3990) - 1) < 1e-3, "pressure of still water in the deep");
            Check.True(Math.Abs(rise[7]) < 1e-3 && Math.Abs(rise[0]) > 1e-2, "the water of the deep is at rest");
            ocean.SampleWater(pointsX, y, pointsZ, new WaterSamples { PressurePa = height }, Interpolation.Cubic, 1000);
            Check.True(Math.Abs(pressure[7] / height[7] - 1.025) < 1e-5, "density");
            Check.Throws<ArgumentException>(() => ocean.SampleWater(pointsX, y, new double[1], default), "z has another length");
            Check.Throws<ArgumentException>(() => ocean.SampleWater(pointsX, y, pointsZ, new WaterSamples { DepthM = new float[7] }), "a short span");
            Check.Equal(Check.Throws<PelagicException>(() => ocean.SampleWater(new double[1], new[] { -4001.0 }, new double[1], default), "floor").Message,
                        "y[0] is -4001, expected at least -4000, the sea floor", "a point below the floor");
        }
        using (var ocean = new Ocean(SmallSea(), new OceanOptions { Queries = true }))
        {
            ocean.Schedule(0);
            ocean.Complete();
            Check.Equal(Check.Throws<PelagicException>(() => ocean.SampleWater(pointsX, y, pointsZ, default), "no depth").Message,
                        "the ocean has no water below its surface: it was created without pelagic_ocean_options.depth", "message");
        }
    }

    [Test]
    public static void WaveInputsHaveTheGoldenHashes()
    {
        var seas = new Dictionary<string, Sea>
        {
            ["stack"] = Of(box =>
            {
                box.Sea.Cascades = 3;
                box.Sea.Resolution = 64;
                box.Sea.WindSpeedMps = 12;
            }),
            ["smallest"] = Of(box =>
            {
                box.Sea.Resolution = 16;
                box.Sea.PatchSizeM = 40;
                box.Sea.WindSpeedMps = 6;
            }),
            ["pond"] = Of(box =>
            {
                box.Sea.Waves = WavesKind.Pond;
                box.Sea.Resolution = 64;
            }),
        };
        double[] amplitude = new double[20], wavelength = new double[20], direction = new double[20], phase = new double[20];
        var length = 180.0;
        for (var i = 0; i < 20; ++i, length *= 0.77)
        {
            amplitude[i] = 0.003 * length;
            wavelength[i] = length;
            direction[i] = 0.61 * (i % 7) - 1.9;
            phase[i] = 0.43 * (i % 11) - 2;
        }
        foreach (var named in seas)
        {
            var sea = named.Value;
            sea.LoopPeriodS = 30;
            using (var waves = WaveInput.Waves(amplitude, wavelength, direction, phase, 0.9))
            using (var rings = WaveInput.Rings(new Ripple { XM = 7.3, ZM = -2.9, WavelengthM = 9, AmplitudeM = 0.5, ReachM = 40 }))
            using (var ocean = new Ocean(sea, new OceanOptions { Velocities = Velocities.Drawn, Slopes = Textures.On, Foam = true, Inputs = new[] { waves, rings } }))
            {
                var found = new List<ulong>();
                Note(ocean, 4.321, found);
                rings.SetRings(new Ripple { XM = -3, ZM = 1e6, WavelengthM = 13, AmplitudeM = 0.25, PhaseRad = 1 });
                Note(ocean, 4.444, found);
                Check.Equal(Expected.Bits(found.Cast<object>().ToArray()), Expected.Text("input " + named.Key), named.Key);
            }
        }
    }

    private static void Note(Ocean ocean, double time, List<ulong> found)
    {
        var frame = FrameAt(ocean, time);
        found.Add(ocean.Hash());
        found.Add(ocean.FoamHash());
        found.Add(HashOf(frame, cascade => new[] { cascade.VelocityX, cascade.VelocityY, cascade.VelocityZ }));
    }

    [Test]
    public static void AnOceanHasTheGoldenValues()
    {
        var options = DynamicWavesOptions.Default;
        options.Resolution = 64;
        options.BorderM = 8;
        Disturbance boat = Disturbance.Default, stone = boat, foam = boat;
        boat.Shape = Shape.Hull;
        boat.XM = -10;
        boat.ZM = 5;
        boat.LengthM = 4;
        boat.HeightM = -0.5;
        boat.VelocityXMps = 6;
        stone.Mode = DisturbanceKind.Impulse;
        stone.XM = 3;
        stone.ZM = -2;
        stone.RadiusM = 2;
        stone.HeightM = 0.4;
        foam.Mode = DisturbanceKind.Foam;
        foam.XM = 12;
        foam.ZM = -10;
        foam.HeightM = 0.3;
        Rain rain = Rain.Default, dry = rain;
        rain.DropsPerM2S = 0.5;
        rain.RadiusM = 1;
        rain.HeightM = 0.1;
        rain.Seed = 3;
        using (var ocean = new Ocean(SmallSea(), new OceanOptions { Queries = true, Velocities = Velocities.Drawn, Foam = true, DynamicWaves = options, Shore = Bay() }))
        {
            var waves = ocean.DynamicWaves;
            waves.SetCenter(0.75, -1);
            for (var tick = 0; tick <= 60; ++tick)
            {
                if (tick == 3) waves.AddImpulse(stone);
                if (tick == 5) Check.Equal(waves.AddSource(boat), 1u, "a number");
                if (tick == 19) boat.HeightM = -1;
                if (tick == 20) waves.SetSource(1, boat);
                if (tick == 25) waves.SetRain(rain);
                if (tick == 30) waves.AddImpulse(foam);
                if (tick == 40)
                {
                    waves.RemoveSource(1);
                    waves.SetRain(dry);
                }
                FrameAt(ocean, tick / 60.0);
                if (tick % 10 == 0)
                    Check.Equal(Expected.Bits(ocean.Hash(), ocean.FoamHash(), waves.Hash(), ocean.ShoreHash()), Expected.Text("waves " + tick), "tick " + tick);
                if (tick != 50) continue;
                var state = waves.SaveState();
                FrameAt(ocean, 52 / 60.0);
                waves.RestoreState(state);
            }
            foreach (var interpolation in new[] { Interpolation.Linear, Interpolation.Cubic })
            {
                var of = Enumerable.Range(0, 10).Select(_ => new float[8]).ToArray();
                var converged = new byte[8];
                ocean.Query(pointsX, pointsZ, new Samples
                {
                    HeightM = of[0], NormalX = of[1], NormalY = of[2], NormalZ = of[3], VelocityXMps = of[4], VelocityYMps = of[5], VelocityZMps = of[6],
                    Jacobian = of[7], ErrorM = of[8], Foam = of[9], Converged = converged,
                }, interpolation);
                for (var i = 0; i < 8; ++i)
                {
                    var row = of.Select(values => (object)values[i]).Append((float)converged[i]).ToArray();
                    Check.Equal(Expected.Bits(row), Expected.Text($"{interpolation.ToString().ToLower()} {i}"), $"sample {i}");
                    if (interpolation == Interpolation.Linear) Check.Equal(ocean.HeightAt(pointsX[i], pointsZ[i]), of[0][i], "HeightAt()");
                }
            }
            for (var i = 0; i < 2; ++i)
            {
                var hit = ocean.FirstHit(new Ray { OriginXM = i == 0 ? 1.5 : 150.5, OriginYM = 12, OriginZM = -7, DirectionX = 1, DirectionY = -0.5, DirectionZ = 0.25, ReachM = 500 });
                Check.Equal(Expected.Bits(hit.DistanceM, hit.PositionXM, hit.PositionYM, hit.PositionZM), Expected.Text("ray " + i), "a hit");
            }
        }
    }

    [Test]
    public static void SprayHasTheGoldenValues()
    {
        var sea = SmallSea();
        sea.WindSpeedMps = 18;
        var bow = SprayEmitter.Default;
        bow.TimeS = 2;
        bow.XM = 1;
        bow.YM = 2;
        bow.ZM = -4;
        bow.ExtentM = 0.5;
        bow.VelocityXMps = 3;
        bow.VelocityYMps = 4;
        bow.SpreadMps = 1;
        bow.RadiusM = 0.0625;
        bow.Count = 10;
        var options = new OceanOptions { Spray = SprayOptions.Default };
        using (var ocean = new Ocean(sea, options))
        using (var other = new Ocean(sea, options))
        {
            ocean.SetSprayCenter(5, -3);
            other.SetSprayCenter(5, -3);
            ocean.Emit(bow);
            other.RestoreSpray(ocean.SaveSpray());
            foreach (var time in new[] { "2.0625", "7.25" })
            {
                var droplets = FrameAt(ocean, double.Parse(time)).Droplets;
                Check.Equal(Expected.Bits(ocean.SprayHash(), (ulong)droplets.Length), Expected.Text("spray " + time), "spray " + time);
                FrameAt(other, double.Parse(time));
                Check.Equal(other.SprayHash(), ocean.SprayHash(), "restored spray " + time);
                foreach (var i in new[] { 0, droplets.Length - 1 })
                {
                    var of = droplets[i];
                    var bits = Expected.Bits(of.PositionXM, of.PositionYM, of.PositionZM, of.VelocityXMps, of.VelocityYMps, of.VelocityZMps, of.RadiusM, of.Opacity, of.AgeS);
                    Check.Equal(bits, Expected.Text($"droplet {time}-{(i == 0 ? "first" : "last")}"), "a droplet");
                }
            }
        }
        using (var without = new Ocean(sea))
        {
            Check.Throws<PelagicException>(() => without.SetSprayCenter(0, 0), "spray without the option");
        }
    }

    [Test]
    public static void ATransitionHasTheGoldenHashes()
    {
        var later = SmallSea();
        later.WindSpeedMps = 6;
        using (var ocean = new Ocean(SmallSea()))
        {
            ocean.ScheduleChange(new Change { Sea = later, FromS = 10, OverS = 20 });
            foreach (var time in new[] { "5", "17.5", "40" })
            {
                FrameAt(ocean, double.Parse(time));
                Check.Equal(ocean.Hash(), Expected.Hash("transition " + time), "transition at " + time);
            }
        }
    }

    [Test]
    public static void TheSampleComputesItsFrames()
    {
        var lines = new List<string>();
        FrameLoop.Run(lines.Add);
        Check.Equal(lines.Count, 5, "lines");
        var sea = Sea.Default;
        sea.WindSpeedMps = 9;
        using (var ocean = new Ocean(sea))
            for (var i = 0; i < 5; ++i)
            {
                FrameAt(ocean, i / 90.0);
                Check.True(lines[i].Contains($"hash {ocean.Hash():x16}"), lines[i]);
            }
    }
}
