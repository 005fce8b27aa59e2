using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using Pelagic;
using Pelagic.Unity;
using UnityEngine;

/// <summary>The fields of an OceanBehaviour, each changed while frames run.</summary>
public static class FieldTests
{
    private delegate void SeaSetter(ref Sea sea);

    private sealed class Change
    {
        internal Action<OceanBehaviour> Set;
        /// <summary>Changes a sea likewise; null: the sea stays.</summary>
        internal SeaSetter SetSea;
        internal Func<OceanBehaviour, bool> Has = behaviour => true;
    }

    private static Sea Storm()
    {
        var sea = Sea.Preset("storm");
        sea.Resolution = 32;
        return sea;
    }

    private static readonly Dictionary<string, Change> changes = new Dictionary<string, Change>
    {
        // The fetch of a preset excludes height and period; Pelagic's default stands for none.
        ["Preset"] = new Change { Set = of => of.Preset = "calm", SetSea = (ref Sea sea) => { sea = Sea.Preset("calm"); sea.Resolution = 32; } },
        ["WindSpeedMps"] = new Change { Set = of => of.WindSpeedMps = 7, SetSea = (ref Sea sea) => sea.WindSpeedMps = 7 },
        // A y rotation of 180 degrees looks along -z of the scene, which is +z of the sea.
        ["WindTowardsDeg"] = new Change { Set = of => of.WindTowardsDeg = 180, SetSea = (ref Sea sea) => sea.WindDirectionRad = Math.PI / 2 },
        ["WaveHeightM"] = new Change { Set = of => of.WaveHeightM = 2, SetSea = (ref Sea sea) => { sea.WaveHeightM = 2; sea.FetchM = 100e3; } },
        ["PeakPeriodS"] = new Change { Set = of => of.PeakPeriodS = 9, SetSea = (ref Sea sea) => { sea.PeakPeriodS = 9; sea.FetchM = 100e3; } },
        ["Systems"] = new Change
        {
            Set = of => of.Systems = new[] { new OceanSystem(), new OceanSystem { HeightM = 1.5f, PeriodS = 11, TowardsDeg = -90, SpreadDeg = 20 } },
            SetSea = (ref Sea sea) =>
            {
                var system = WaveSystem.Default;
                system.HeightM = 1.5;
                system.PeakPeriodS = 11;
                system.DirectionRad = -Math.PI;
                system.SpreadRad = 20 * Math.PI / 180;
                sea.Systems = new[] { system };
            },
        },
        ["SeaDepthM"] = new Change { Set = of => of.SeaDepthM = 8, SetSea = (ref Sea sea) => sea.DepthM = 8 },
        ["Choppiness"] = new Change { Set = of => of.Choppiness = 0.25f, SetSea = (ref Sea sea) => sea.Choppiness = 0.25 },
        ["Lean"] = new Change { Set = of => of.Lean = 0.125f, SetSea = (ref Sea sea) => sea.Lean = 0.125 },
        ["Cascades"] = new Change { Set = of => of.Cascades = 2, SetSea = (ref Sea sea) => sea.Cascades = 2, Has = of => of.Frame.CascadeCount == 2 && of.Slopes.Depth == 2 },
        ["Resolution"] = new Change { Set = of => of.Resolution = 64, SetSea = (ref Sea sea) => sea.Resolution = 64, Has = of => of.Slopes.Side == 64 },
        // In the world the sea is higher, and moves with the current.
        ["SeaLevelM"] = new Change
        {
            Set = of => of.SeaLevelM = 12.5f,
            Has = of => of.Frame.Water.SeaLevelM == 12.5 && Math.Abs(of.HeightAt(new Vector3(3, 0, 4)) - 12.5) < 12 && Math.Abs(MeanHeightM(of) - 12.5) < 1,
        },
        ["CurrentMps"] = new Change { Set = of => of.CurrentMps = new Vector2(1, 2), Has = of => of.Frame.Water.CurrentXMps == 1 && of.Frame.Water.CurrentZMps == -2 },
        ["Foam"] = new Change { Set = of => of.Foam = true, Has = of => of.Snapshots != null && !of.Frame.Cascade(0).SnapshotsRgba8(0).IsEmpty },
        // Drops leave breaking crests within 80 m.
        ["Spray"] = new Change { Set = of => of.Spray = true },
        ["SprayAmount"] = new Change { Set = of => { of.Spray = true; of.SprayAmount = 10; }, Has = of => of.Frame.Droplets.Length > 0 },
        ["SprayCenter"] = new Change
        {
            Set = of => { of.Spray = true; of.SprayAmount = 10; of.SprayCenter = new Transform { position = new Vector3(300, 2, -300) }; },
            Has = of => of.Frame.Droplets.Length > 0 && Math.Abs(of.Frame.Droplets[0].PositionXM - 300) < 100 && Math.Abs(of.Frame.Droplets[0].PositionZM - 300) < 100,
        },
        ["Velocities"] = new Change { Set = of => of.Velocities = true, Has = of => !of.Frame.Cascade(0).VelocityY.IsEmpty },
        ["Depth"] = new Change { Set = of => of.Depth = true, Has = of => PressureAt(of, -2) > 0 },
        ["DynamicWaves"] = new Change { Set = of => of.DynamicWaves = true, Has = of => of.Ocean.DynamicWaves != null && of.Frame.DynamicWaves.Resolution == 256 },
        ["Threads"] = new Change { Set = of => of.Threads = 1, Has = of => of.Ocean.Info.Threads == 1 && of.Ocean.Info.Executor == "thread" },
        ["CpuMask"] = new Change { Set = of => { of.Threads = 2; of.CpuMask = 1; }, Has = of => of.Ocean.Info.Executor == "thread" },
    };

    private static double MeanHeightM(OceanBehaviour behaviour)
    {
        return Enumerable.Range(0, 400).Average(i => (double)behaviour.HeightAt(new Vector3(i % 20 * 61, 0, i / 20 * 67)));
    }

    private static float PressureAt(OceanBehaviour behaviour, double y)
    {
        var pressure = new float[1];
        behaviour.Ocean.SampleWater(new double[1], new[] { behaviour.Ocean.HeightAt(0, 0) + y }, new double[1], new WaterSamples { PressurePa = pressure });
        return pressure[0];
    }

    private static OceanBehaviour Enabled()
    {
        UnityEngine.Time.timeAsDouble = 2;
        Debug.Errors.Clear();
        var behaviour = new OceanBehaviour { Preset = "storm", Resolution = 32, Foam = false, Threads = 1 };
        BehaviourTests.Send(behaviour, "OnEnable");
        BehaviourTests.Send(behaviour, "Update");
        return behaviour;
    }

    private static IEnumerable<FieldInfo> Fields(Type type) => type.GetFields(BindingFlags.Instance | BindingFlags.Public).Where(field => field.DeclaringType == type);

    [Test]
    public static void EachFieldTakesEffectWhileFramesRun()
    {
        var names = new HashSet<string>(Fields(typeof(OceanBehaviour)).Select(field => field.Name));
        Check.True(names.SetEquals(changes.Keys), "the fields are " + string.Join(" ", names.Except(changes.Keys).Concat(changes.Keys.Except(names))));
        foreach (var entry in changes)
        {
            var behaviour = Enabled();
            var sea = Storm();
            using (var plain = new Ocean(sea, new OceanOptions { Queries = true }))
            {
                GoldenTests.FrameAt(plain, behaviour.Frame.TimeS);
                Check.Equal(behaviour.HeightAt(new Vector3(3, 0, 4)), plain.HeightAt(3, -4), "height before");
            }
            entry.Value.Set(behaviour);
            // The frame in flight is still of the old sea.
            var expected = sea;
            entry.Value.SetSea?.Invoke(ref expected);
            BehaviourTests.UpdateUntil(behaviour, () => behaviour.Sea.Equals(expected) && entry.Value.Has(behaviour), entry.Key);
            if (entry.Value.SetSea != null)
                using (var plain = new Ocean(expected, new OceanOptions { Queries = true }))
                {
                    GoldenTests.FrameAt(plain, behaviour.Frame.TimeS);
                    for (var i = 0; i < 50; ++i)
                        Check.Equal(behaviour.HeightAt(new Vector3(17 * i, 0, 11 * i)), plain.HeightAt(17 * i, -11 * i), $"height with another {entry.Key}");
                }
            Check.Equal(string.Join("\n", Debug.Errors), "", "errors of " + entry.Key);
            BehaviourTests.Send(behaviour, "OnDisable");
        }
        Check.Equal(Texture2DArray.Live, 0, "textures left");
    }

    [Test]
    public static void EachNumberHasARangeAndEachFieldATooltip()
    {
        foreach (var type in new[] { typeof(OceanBehaviour), typeof(OceanSystem), typeof(OceanSurface), typeof(OceanFloating), typeof(FloatingOrigin) })
            foreach (var field in Fields(type))
            {
                // Names of components and materials say what they are.
                var isReference = typeof(UnityEngine.Object).IsAssignableFrom(field.FieldType);
                Check.True(isReference || field.GetCustomAttribute<TooltipAttribute>() != null, $"{type.Name}.{field.Name} has a tooltip");
                // Powers of two, masks and masses have no sliders.
                var isFree = new[] { "Resolution", "CpuMask", "MassKg" }.Contains(field.Name);
                var isNumber = field.FieldType == typeof(float) || field.FieldType == typeof(int);
                Check.True(!isNumber || isFree || field.GetCustomAttribute<RangeAttribute>() != null, $"{type.Name}.{field.Name} has a range");
            }
    }

    /// <summary>The ends of each slider are accepted, in an inspector that validates, except where the tooltip says so.</summary>
    [Test]
    public static void TheEndsOfSlidersAreValid()
    {
        foreach (var field in Fields(typeof(OceanBehaviour)))
        {
            var range = field.GetCustomAttribute<RangeAttribute>();
            if (range == null) continue;
            foreach (var end in new[] { range.min, range.max })
            {
                Debug.Errors.Clear();
                var behaviour = new OceanBehaviour { Resolution = 32 };
                field.SetValue(behaviour, field.FieldType == typeof(int) ? (object)(int)end : end);
                BehaviourTests.Send(behaviour, "OnValidate");
                Check.Equal(string.Join("\n", Debug.Errors), "", $"{field.Name} of {end}");
            }
        }
        foreach (var field in Fields(typeof(OceanSystem)))
            foreach (var end in new[] { field.GetCustomAttribute<RangeAttribute>().min, field.GetCustomAttribute<RangeAttribute>().max })
            {
                object system = new OceanSystem { HeightM = 1, PeriodS = 9 };
                field.SetValue(system, end);
                BehaviourTests.Send(new OceanBehaviour { Systems = new[] { (OceanSystem)system } }, "OnValidate");
                Check.Equal(string.Join("\n", Debug.Errors), "", $"{field.Name} of a system of {end}");
            }
    }

    [Test]
    public static void AnInvalidFieldIsOneLineAndTheSeaStays()
    {
        var invalid = new (Action<OceanBehaviour>, string)[]
        {
            (of => of.Preset = "nonsense", "preset is nonsense, expected one of "),
            (of => of.WindSpeedMps = -3, "wind_speed_mps -3 is out of range (0, 60]"),
            (of => of.WindSpeedMps = float.NaN, "wind_speed_mps "),
            (of => of.Resolution = 33, "resolution "),
            (of => of.Cascades = 5, "cascades "),
            (of => of.SeaDepthM = -1, "depth_m -1 is out of range [0.01, 11000]"),
            (of => of.Systems = new OceanSystem[9], "Systems has 9 elements, expected 0 to 8"),
            (of => of.Systems = new[] { new OceanSystem { HeightM = 31 } }, "system"),
            (of => of.Threads = 2000, "Threads is 2000, expected 0 to 1024"),
            (of => of.CpuMask = 1UL << 63, "cpu_mask is 0x8000000000000000, expected a CPU that this process may use"),
            (of => of.SeaLevelM = 2000, "SeaLevelM is 2000, expected a value in [-1000, 1000]"),
            (of => of.CurrentMps = new Vector2(0, 11), "CurrentMps is (0, 11), expected values in [-10, 10]"),
            (of => of.SprayAmount = 11, "SprayAmount is 11, expected a value in [0, 10]"),
        };
        foreach (var entry in invalid)
        {
            var message = entry.Item2;
            var behaviour = Enabled();
            behaviour.Threads = 0;  // masks need threads
            BehaviourTests.Send(behaviour, "Update");
            var good = Fields(typeof(OceanBehaviour)).Select(field => (field, field.GetValue(behaviour))).ToArray();
            entry.Item1(behaviour);
            // What is valid waits for the rest.
            behaviour.Lean = 0.25f;
            behaviour.Velocities = true;
            for (var i = 0; i < 5; ++i)
            {
                UnityEngine.Time.timeAsDouble += 0.01;
                BehaviourTests.Send(behaviour, "Update");
                BehaviourTests.Send(behaviour, "OnValidate");
            }
            Check.Equal(Debug.Errors.Count, 1, "errors of " + message);
            Check.True(Debug.Errors[0].StartsWith("OceanBehaviour 'Thing': " + message) && !Debug.Errors[0].Contains("\n"), Debug.Errors[0]);
            Check.True(behaviour.HasFrame && behaviour.Problem != null && behaviour.Sea.Equals(Storm()), "the sea before");
            foreach (var field in good) field.Item1.SetValue(behaviour, field.Item2);
            behaviour.WindSpeedMps = 11;
            behaviour.Foam = true;
            BehaviourTests.UpdateUntil(behaviour, () => behaviour.Sea.WindSpeedMps == 11 && behaviour.Snapshots != null, "a valid sea");
            Check.True(behaviour.Problem == null && Debug.Errors.Count == 1, "no problem");
            behaviour.Lean = 0.25f;
            BehaviourTests.UpdateUntil(behaviour, () => behaviour.Sea.Lean == 0.25, "what waited");
            BehaviourTests.Send(behaviour, "OnDisable");
        }
        // An ocean that never had a valid field begins with the first.
        var late = new OceanBehaviour { Preset = "nonsense", Resolution = 32 };
        BehaviourTests.Send(late, "OnEnable");
        BehaviourTests.Send(late, "Update");
        Check.True(late.Ocean == null && !late.HasFrame, "no ocean");
        late.Preset = "calm";
        BehaviourTests.Send(late, "Update");
        Check.True(late.HasFrame, "a frame");
        BehaviourTests.Send(late, "OnDisable");
    }

    /// <summary>Compares with the forecast of an ocean of the C interface.</summary>
    [Test]
    public static void ATransitionIsThatOfAForecast()
    {
        var behaviour = Enabled();
        var target = Sea.Preset("moderate");
        target.WindSpeedMps = 9;
        behaviour.TransitionTo(target, 3);
        UnityEngine.Time.timeAsDouble += 0.5;
        BehaviourTests.Send(behaviour, "Update");
        var beginS = UnityEngine.Time.timeAsDouble;
        target.Resolution = 32;
        using (var plain = new Ocean(Storm(), new[] { new Pelagic.Change { Sea = target, FromS = beginS, OverS = 2.5 } }, 0, new OceanOptions { Queries = true }))
        {
            double lastM = double.MaxValue;
            var between = 0;
            for (var i = 0; i < 36; ++i)
            {
                UnityEngine.Time.timeAsDouble += 0.1;
                BehaviourTests.Send(behaviour, "Update");
                GoldenTests.FrameAt(plain, behaviour.Frame.TimeS);
                // The forecast's cascades are those of both seas, and the behaviour's of the first: the same for a calmer one.
                Check.Equal(behaviour.HeightAt(new Vector3(3, 0, 4)), plain.HeightAt(3, -4), "height");
                Check.True(behaviour.Frame.WaveHeightM <= lastM, "the sea calms down");
                lastM = behaviour.Frame.WaveHeightM;
                if (!behaviour.Sea.Equals(Storm()) && !behaviour.Sea.Equals(target)) ++between;
            }
            Check.True(between >= 23 && behaviour.Sea.Equals(target), $"{between} frames of a transition");
        }
        // A field that changes shows the sea of the fields.
        behaviour.Choppiness = 0.5f;
        BehaviourTests.UpdateUntil(behaviour, () => behaviour.Sea.Choppiness == 0.5 && behaviour.Sea.WindSpeedMps == Storm().WindSpeedMps, "the sea of the fields");
        // Another option keeps the sea that is shown.
        behaviour.TransitionTo(target, 0.5);
        BehaviourTests.UpdateUntil(behaviour, () => behaviour.Sea.Equals(target), "the end of a transition");
        behaviour.Foam = true;
        BehaviourTests.Send(behaviour, "Update");
        Check.True(behaviour.Sea.Equals(target) && behaviour.Snapshots != null, "the sea of a transition with foam");
        // In a transition, too.
        behaviour.TransitionTo(Storm(), 10);
        for (var i = 0; i < 5; ++i)
        {
            UnityEngine.Time.timeAsDouble += 1;
            BehaviourTests.Send(behaviour, "Update");
        }
        behaviour.Foam = false;
        BehaviourTests.Send(behaviour, "Update");
        Check.True(behaviour.Snapshots == null && behaviour.Sea.WindSpeedMps > target.WindSpeedMps && behaviour.Sea.WindSpeedMps < Storm().WindSpeedMps, "a sea between");
        BehaviourTests.UpdateUntil(behaviour, () => behaviour.Sea.Equals(Storm()), "the end of a transition of two oceans");
        Check.Throws<ArgumentException>(() => behaviour.TransitionTo(target, 0), "no time");
        target.WindSpeedMps = -1;
        Check.Throws<PelagicException>(() => behaviour.TransitionTo(target, 1), "no wind");
        BehaviourTests.Send(behaviour, "OnDisable");
        Check.Throws<InvalidOperationException>(() => behaviour.TransitionTo(Storm(), 1), "no ocean");
    }

    [Test]
    public static void TheGuidesComponentChangesTheSea()
    {
        var behaviour = Enabled();
        var weather = new Weather { Ocean = behaviour, Buoy = new Transform { position = new Vector3(5, 9, 6) } };
        behaviour.Preset = "calm";
        BehaviourTests.UpdateUntil(behaviour, () => behaviour.Sea.WindSpeedMps == Sea.Preset("calm").WindSpeedMps, "a calm");
        BehaviourTests.Send(weather, "Start");
        var calmM = behaviour.Frame.WaveHeightM;
        // The storm needs another ocean, which the second update creates.
        for (var i = 0; i < 5; ++i)
        {
            UnityEngine.Time.timeAsDouble += i < 2 ? 0.01 : 300;
            BehaviourTests.Send(behaviour, "Update");
        }
        BehaviourTests.Send(weather, "LateUpdate");
        var storm = Sea.Preset("storm");
        storm.Resolution = 32;
        Check.True(behaviour.Sea.Equals(storm) && behaviour.Problem == null, "the sea of a storm");
        // By the preset 8 m, of which 32 texels hold most.
        Check.True(behaviour.Frame.WaveHeightM > 5 && calmM < 0.5 && weather.Buoy.position.y == behaviour.HeightAt(weather.Buoy.position), "a storm");
        BehaviourTests.Send(behaviour, "OnDisable");
    }

    /// <summary>A slider that moves in every frame requests many seas; the last is shown.</summary>
    [Test]
    public static void TheLastOfManySeasIsShown()
    {
        var behaviour = Enabled();
        for (var i = 0; i < 40; ++i)
        {
            behaviour.WindSpeedMps = 5 + i * 0.25f;
            UnityEngine.Time.timeAsDouble += 0.01;
            BehaviourTests.Send(behaviour, "Update");
        }
        BehaviourTests.UpdateUntil(behaviour, () => behaviour.Sea.WindSpeedMps == 14.75, "the last sea");
        // Another kind of waves needs another ocean.
        behaviour.Preset = "pond";
        behaviour.WindSpeedMps = 0;
        BehaviourTests.UpdateUntil(behaviour, () => behaviour.Sea.Waves == WavesKind.Pond, "a pond");
        BehaviourTests.Send(behaviour, "OnDisable");
    }

    [Test]
    public static void AnEventThatThrowsLosesNoFrames()
    {
        var behaviour = Enabled();
        Action fails = () => throw new NotSupportedException();
        behaviour.BetweenFrames += fails;
        Check.Throws<NotSupportedException>(() => BehaviourTests.Send(behaviour, "Update"), "the event");
        behaviour.BetweenFrames -= fails;
        UnityEngine.Time.timeAsDouble = 5;
        BehaviourTests.Send(behaviour, "Update");
        Check.Equal(behaviour.Frame.TimeS, 5.0, "time of a frame");
        BehaviourTests.Send(behaviour, "OnDisable");
    }
}
