using System;
using System.Collections.Generic;
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
            ["spreading-donelan-banner-64"] = OneCascade(box => box.Sea.Spreading = Spreading.DonelanBanner),
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
        foreach (var name in new[] { "jonswap-64", "phillips-64", "phillips-paper-64", "pierson-moskowitz-64" })
        {
            var sea = Seas()[name];
            sea.Roughness = 0.1;
            using (var ocean = new Ocean(sea))
                foreach (var time in new[] { "0", "12.34" })
                {
                    var found = HashOf(FrameAt(ocean, double.Parse(time)), cascade => new[] { cascade.Dx, cascade.Height, cascade.Dz });
                    Check.Equal(found, Expected.Hash($"displacement {name}@{time}"), $"displacement {name}@{time}");
                }
        }
    }

    [Test]
    public static void AShoreHasTheGoldenHashes()
    {
        var shore = new ShoreOptions { Columns = 81, Rows = 61, MetresASample = 5, CornerXM = -170, CornerZM = -130, Resolution = 64 };
        shore.HeightsM = new float[81 * 61];
        for (var j = 0; j < 61; ++j)
            for (var i = 0; i < 81; ++i)
            {
                double x = 5 * i, fromX = x - 150, fromZ = 5 * j - 120, squared = (fromX * fromX + fromZ * fromZ) / 1600;
                shore.HeightsM[j * 81 + i] = (float)(-12 + x * 0.035 + 16 / (1 + squared * squared));
            }
        var sea = Of(box =>
        {
            box.Sea.Cascades = 3;
            box.Sea.Resolution = 32;
            box.Sea.WindSpeedMps = 8;
            box.Sea.LoopPeriodS = 40;
        });
        using (var ocean = new Ocean(sea, new OceanOptions { Shore = shore, Queries = true }))
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
            using (var ocean = new Ocean(sea, new OceanOptions { Velocities = true, Slopes = true, Foam = true, Inputs = new[] { waves, rings } }))
            {
                var found = new List<ulong>();
                Note(ocean, 4.321, found);
                rings.SetRings(new Ripple { XM = -3, ZM = 1e6, WavelengthM = 13, AmplitudeM = 0.25, PhaseRad = 1 });
                Note(ocean, 4.444, found);
                for (var i = 0; i < found.Count; ++i) Check.Equal(found[i], Expected.Hash($"input {named.Key} {i}"), $"{named.Key} {i}");
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
    public static void DynamicWavesHaveTheHashOfTheCInterface()
    {
        var options = DynamicWavesOptions.Default;
        options.Resolution = 64;
        var boat = Disturbance.Default;
        boat.Shape = Shape.Hull;
        boat.XM = -10;
        boat.LengthM = 4;
        boat.HeightM = -0.5;
        boat.VelocityXMps = 6;
        var stone = Disturbance.Default;
        stone.Mode = DisturbanceKind.Impulse;
        stone.HeightM = 0.4;
        using (var waves = new DynamicWaves(options))
        {
            waves.Advance(0);
            waves.AddSource(boat);
            waves.AddImpulse(stone);
            waves.Advance(0.25);
            var state = waves.SaveState();
            waves.Advance(0.5);
            Check.Equal(waves.Hash(), Expected.Hash("dynamic waves"), "dynamic waves");
            waves.RestoreState(state);
            waves.Advance(0.5);
            Check.Equal(waves.Hash(), Expected.Hash("dynamic waves"), "restored dynamic waves");
            float highest = 0;
            foreach (var height in waves.View.HeightM) highest = Math.Max(highest, height);
            Check.Equal(highest, Math.Max(0, waves.View.HeightMaxM), "highest wave");
        }
    }

    [Test]
    public static void TheSampleComputesTheFramesOfTheCInterface()
    {
        var lines = new List<string>();
        FrameLoop.Run(lines.Add);
        Check.Equal(lines.Count, 5, "lines");
        for (var i = 0; i < 5; ++i) Check.True(lines[i].Contains("hash " + Expected.Text($"frame loop {i}")), lines[i]);
    }
}
