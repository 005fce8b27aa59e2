using System;
using System.Diagnostics;
using UnityEngine;

namespace Pelagic.Unity
{
    /// <summary>
    /// An ocean in a scene. Each Update() completes the frame that the previous one scheduled, sends its textures to the
    /// GPU and schedules the next, which is computed while the scene is drawn. Unity's z axis is -z of the sea. Fields
    /// may be changed at any time and take effect in the next Update(): another sea is computed beside frames, other
    /// options create a new ocean.
    ///
    /// Shaders find the textures as _PelagicDisplacement, _PelagicSlopes and _PelagicMoments, arrays with one slice
    /// for each cascade, and _PelagicCascades: side in metres, cosine, sine and slope range. With Foam, slice 3 i + j
    /// of _PelagicSnapshots is image i of 2 of the snapshots of cascade j of 3. The first three are not in Frame.
    /// </summary>
    [DefaultExecutionOrder(-100)]
    public sealed unsafe class OceanBehaviour : MonoBehaviour
    {
        private const int MaxCascades = 4, FoamCascades = 3, SnapshotImages = 2, MaxSystems = 8;
        private static readonly int displacementId = Shader.PropertyToID("_PelagicDisplacement"), slopesId = Shader.PropertyToID("_PelagicSlopes"),
                                    momentsId = Shader.PropertyToID("_PelagicMoments"),
                                    snapshotsId = Shader.PropertyToID("_PelagicSnapshots"), cascadesId = Shader.PropertyToID("_PelagicCascades");

        [Header("Sea")]
        [Tooltip("calm, lake, swell, moderate, rough, storm, pond, analytic-calm, analytic-moderate, analytic-intense, or beaufort-0 to beaufort-12.")]
        public string Preset = "moderate";
        [Range(0, 60), Tooltip("Mean wind speed 10 m above the sea in m/s. 0: that of the preset.")]
        public float WindSpeedMps;
        [Range(-180, 180), Tooltip("Direction that the wind blows towards, as the y rotation of a transform, in degrees.")]
        public float WindTowardsDeg = 90;
        [Range(0, 30), Tooltip("Significant height of the waves of the wind in metres. 0: by preset, wind and period.")]
        public float WaveHeightM;
        [Range(0, 40), Tooltip("Peak period of the waves of the wind in seconds; 1 or more. 0: by preset, wind and height.")]
        public float PeakPeriodS;
        [Tooltip("At most 8 wave systems, for instance swells.")]
        public OceanSystem[] Systems = new OceanSystem[0];
        [Range(0, 11000), Tooltip("Depth of the water in metres; 0.01 or more. 0: that of the preset.")]
        public float SeaDepthM;
        [Range(-1, 1), Tooltip("Scale of horizontal displacements. -1: that of the preset.")]
        public float Choppiness = -1;
        [Range(-1, 0.6f), Tooltip("Forward displacement of crests, which makes fronts steeper than backs. -1: by the wind.")]
        public float Lean = -1;
        [Range(-1000, 1000), Tooltip("Height of still water in the scene, in metres.")]
        public float SeaLevelM;
        [Tooltip("Velocity of the water along x and z of the scene in m/s; [-10, 10]. It has flowed since the start: a change moves the sea.")]
        public Vector2 CurrentMps;

        [Header("Output")]
        [Range(0, 4), Tooltip("Bands of wavelengths. 0: four. OceanSurface needs four.")]
        public int Cascades;
        [Tooltip("Texels along a side of a cascade, a power of two from 16 to 2048. 0: that of the preset, 128.")]
        public int Resolution;
        [Tooltip("Computes foam.")]
        public bool Foam = true;
        [Tooltip("Computes spray near SprayCenter; see Frame.Droplets.")]
        public bool Spray;
        [Range(0, 10), Tooltip("Factor on the number of droplets.")]
        public float SprayAmount = 1;
        [Tooltip("Centre of the spray, usually the camera. None: the origin.")]
        public Transform SprayCenter;
        [Tooltip("Computes velocities of the surface for queries.")]
        public bool Velocities;
        [Tooltip("Computes pressure and velocity below the surface, which OceanFloating needs.")]
        public bool Depth;
        [Tooltip("Computes wakes and ripples with DynamicWavesOptions.Default; see Ocean.DynamicWaves.")]
        public bool DynamicWaves;

        [Header("Threads")]
        [Range(0, 64), Tooltip("Threads that compute a frame, the main thread included. 1: the main thread only. 0, or more than CPUs: one for each CPU.")]
        public int Threads;
        [Tooltip("Bit i lets the other threads run on CPU i. 0: all CPUs. Linux, Android and Windows only.")]
        public ulong CpuMask;

        /// <summary>What the fields request: a sea, its water, and options of an ocean.</summary>
        private struct Values
        {
            internal Sea Sea;
            internal WaterFrame Water;
            internal int Threads;
            internal ulong CpuMask;
            internal float SprayAmount;
            internal bool Foam, Spray, Velocities, Depth, DynamicWaves;

            internal bool HasOptionsOf(in Values other)
            {
                return Threads == other.Threads && CpuMask == other.CpuMask && SprayAmount == other.SprayAmount && Foam == other.Foam && Spray == other.Spray &&
                       Velocities == other.Velocities && Depth == other.Depth && DynamicWaves == other.DynamicWaves;
            }

            internal bool HasWaterOf(in Values other)
            {
                return Water.SeaLevelM == other.Water.SeaLevelM && Water.CurrentXMps == other.Water.CurrentXMps && Water.CurrentZMps == other.Water.CurrentZMps;
            }
        }

        // An array of this length, because Unity fixes the length of a shader's array at the first call.
        private readonly Vector4[] cascades = new Vector4[MaxCascades];
        private readonly ulong[] versions = new ulong[FoamCascades * SnapshotImages];
        private readonly FrameTextures[] textures = new FrameTextures[2];
        private int drawn;                             // of textures; the other is written
        private (double X, double Z)? origin;          // of the next frames
        private (double X, double Z) shown;            // origin of Frame
        private string presetName, presetProblem, problem;
        private Sea preset;
        private Values read, applied;                  // of the fields: in the last Update(), and those that were valid last
        private double transitionEndS;                 // of the transition to Target
        private bool isUsable, wasRead, hasNext, isComputing, needsOcean, isInFlight;  // hasNext: Target is not scheduled yet

        /// <summary>Null while the component is disabled, and if a field is invalid.</summary>
        public Ocean Ocean { get; private set; }
        /// <summary>The frame that is drawn, if HasFrame.</summary>
        public Frame Frame { get; private set; }
        public bool HasFrame { get; private set; }
        /// <summary>The textures of Frame. They alternate: use them for one frame.</summary>
        public Texture2DArray Displacement => textures[drawn]?.Displacement;
        public Texture2DArray Slopes => textures[drawn]?.Slopes;
        public Texture2DArray Moments => textures[drawn]?.Moments;
        /// <summary>Null without Foam.</summary>
        public Texture2DArray Snapshots { get; private set; }
        /// <summary>The sea of Frame, which lies between two seas during a transition.</summary>
        public Sea Sea { get; private set; }
        /// <summary>The sea that the fields or TransitionTo() requested last.</summary>
        public Sea Target { get; private set; }
        /// <summary>One line about the first invalid field, or null.</summary>
        public string Problem => problem;
        /// <summary>Time that the last Update() waited for its frame, and all of its time, without events; milliseconds.</summary>
        public double WaitMs { get; private set; }
        public double UpdateMs { get; private set; }
        /// <summary>Memory of the ocean and of the textures, which the GPU holds, too.</summary>
        public long MemoryBytes { get; private set; }

        /// <summary>Between frames of Ocean, after Complete() and before Schedule().</summary>
        public event Action BetweenFrames;
        /// <summary>When Frame has another origin than the one before: positions of the scene change by the argument.</summary>
        public event Action<Vector3> OriginShifted;

        /// <summary>
        /// Shifts the origin to a position of the sea, as Ocean.SetOrigin(), in the next Update(), after BetweenFrames. Move
        /// the scene and the camera in OriginShifted, as FloatingOrigin does. OceanFloating moves by itself.
        /// </summary>
        public void SetOrigin(double xM, double zM)
        {
            origin = (xM, zM);
        }

        /// <summary>
        /// Changes the sea to another over a time in seconds, (0, 1e9], from the next Update() on. Resolution, number of
        /// cascades, depth, loop period and seed stay. Fields keep their values: a field that changes later requests the
        /// sea of the fields again. A sea of much longer waves needs another ocean, with longer cascades: the water jumps
        /// once, at the start. Throws a PelagicException for an invalid sea.
        /// </summary>
        public void TransitionTo(Sea sea, double seconds)
        {
            if (!(seconds > 0 && seconds <= 1e9)) throw new ArgumentException($"seconds is {seconds}, expected a value in (0, 1e9]");
            if (Ocean == null) throw new InvalidOperationException($"OceanBehaviour '{name}' has no ocean: it is disabled or a field is invalid");
            var current = Target;
            (sea.Resolution, sea.Cascades, sea.DepthM, sea.LoopPeriodS, sea.Seed) = (current.Resolution, current.Cascades, current.DepthM, current.LoopPeriodS, current.Seed);
            sea.Check();
            Request(sea, seconds);
        }

        /// <summary>Height of the water at a position of the scene.</summary>
        public float HeightAt(Vector3 position)
        {
            return Ocean.HeightAt(position.x, -position.z);
        }

        /// <summary>Computes the sea of the fields. Returns null, or one line about the first invalid field.</summary>
        public string Check(out Sea sea)
        {
            sea = SeaOfFields();
            if (presetProblem != null) return presetProblem;
            if (Systems != null && Systems.Length > MaxSystems) return $"Systems has {Systems.Length} elements, expected 0 to {MaxSystems}";
            if (Threads < 0 || Threads > 1024) return $"Threads is {Threads}, expected 0 to 1024";
            if (!(SprayAmount >= 0 && SprayAmount <= 10)) return $"SprayAmount is {SprayAmount}, expected a value in [0, 10]";
            if (!(Math.Abs(SeaLevelM) <= 1000)) return $"SeaLevelM is {SeaLevelM}, expected a value in [-1000, 1000]";
            if (!(Math.Abs(CurrentMps.x) <= 10 && Math.Abs(CurrentMps.y) <= 10)) return $"CurrentMps is ({CurrentMps.x}, {CurrentMps.y}), expected values in [-10, 10]";
            try
            {
                sea.Check();
            }
            catch (PelagicException exception)
            {
                return exception.Message;
            }
            return null;
        }

        private void OnValidate()
        {
            // Between "that of the preset" and 0 a slider has no values.
            if (Choppiness < 0) Choppiness = -1;
            if (Lean < 0) Lean = -1;
            var found = PelagicLibrary.Problem() ?? Check(out _);
            // Those of threads are found when an ocean is created.
            if (found != null || Ocean == null) Problems.Report(ref problem, found, this);
        }

        private void OnEnable()
        {
            var missing = PelagicLibrary.Problem();
            isUsable = missing == null;
            wasRead = false;
            if (isUsable) ReadFields();
            else Problems.Report(ref problem, missing, this);
        }

        private void Update()
        {
            if (!isUsable) return;
            var began = Stopwatch.GetTimestamp();
            ReadFields();
            if (Ocean == null) return;
            if (!isInFlight) Schedule();  // after an exception
            isInFlight = false;
            var ready = Stopwatch.GetTimestamp();
            Frame = Ocean.Complete();
            var completed = Stopwatch.GetTimestamp();
            HasFrame = true;
            Sea = Ocean.Sea;
            drawn = 1 - drawn;
            textures[drawn].Apply(Frame);
            SetShaders();
            RequestSea();
            var done = Stopwatch.GetTimestamp();
            FollowOrigin();
            BetweenFrames?.Invoke();
            var resumed = Stopwatch.GetTimestamp();
            Schedule();
            WaitMs = Milliseconds(completed - ready);
            UpdateMs = Milliseconds(done - began + Stopwatch.GetTimestamp() - resumed);
        }

        private static double Milliseconds(long ticks) => ticks * 1e3 / Stopwatch.Frequency;

        private void OnDisable()
        {
            HasFrame = false;
            // First, because the frame in flight writes into the textures.
            Ocean?.Dispose();
            Ocean = null;
            for (var i = 0; i < textures.Length; ++i)
            {
                textures[i]?.Destroy();
                textures[i] = null;
            }
            if (Snapshots != null) Destroy(Snapshots);
            Snapshots = null;
            (hasNext, isComputing, needsOcean) = (false, false, false);
        }

        /// <summary>Requests the sea of the fields if they have changed, or creates an ocean if it needs another.</summary>
        private void ReadFields()
        {
            var wanted = new Values
            {
                Sea = SeaOfFields(), Water = new WaterFrame { SeaLevelM = SeaLevelM, CurrentXMps = CurrentMps.x, CurrentZMps = -CurrentMps.y }, Threads = Threads,
                CpuMask = CpuMask, SprayAmount = SprayAmount, Foam = Foam, Spray = Spray, Velocities = Velocities, Depth = Depth, DynamicWaves = DynamicWaves,
            };
            if (wasRead && !needsOcean && AreEqual(wanted.Sea, read.Sea) && wanted.HasWaterOf(read) && wanted.HasOptionsOf(read)) return;
            (read, wasRead) = (wanted, true);
            Problems.Report(ref problem, Check(out _), this);
            if (problem != null) return;
            var isOther = Ocean == null || needsOcean || !wanted.HasOptionsOf(applied);
            if (Ocean == null || !AreEqual(wanted.Sea, applied.Sea)) Request(wanted.Sea, 0);
            applied = wanted;
            if (isOther) Create();
        }

        private void Request(in Sea sea, double seconds)
        {
            (Target, transitionEndS, hasNext) = (sea, Time.timeAsDouble + seconds, true);
        }

        /// <summary>Between frames: makes a sea that has been computed current, and starts with the next.</summary>
        private void RequestSea()
        {
            if (isComputing && Ocean.IsSeaReady)
            {
                Ocean.CompleteSea();
                isComputing = false;
            }
            if (!hasNext || isComputing) return;
            hasNext = false;
            try
            {
                if (IsInTransition) Ocean.ScheduleChange(RestOfTransition());
                else Ocean.ScheduleSea(Target);
                isComputing = !IsInTransition;
            }
            catch (PelagicException exception) when (exception.Status == Status.InvalidArgument)
            {
                // A sea of another kind or size, or of longer waves, needs another ocean, which the next Update() creates.
                needsOcean = true;
            }
        }

        private bool IsInTransition => transitionEndS > Time.timeAsDouble;

        private Change RestOfTransition() => new Change { Sea = Target, FromS = Time.timeAsDouble, OverS = transitionEndS - Time.timeAsDouble };
        /// <summary>Replaces the ocean by one of Target, or of the transition to it, whose first frame is in flight.</summary>
        private void Create()
        {
            Ocean created = null;
            try
            {
                using (var executor = new Executor(new ExecutorOptions { Kind = ExecutorKind.Threads, Threads = Threads, CpuMask = CpuMask }))
                {
                    var ocean = new OceanOptions { Executor = executor, Queries = true, Depth = Depth, Slopes = Pelagic.Textures.On, Foam = Foam };
                    if (Velocities) ocean.Velocities = Pelagic.Velocities.Drawn;
                    if (DynamicWaves) ocean.DynamicWaves = DynamicWavesOptions.Default;
                    var spray = SprayOptions.Default;
                    spray.Amount = SprayAmount;
                    if (Spray) ocean.Spray = spray;
                    // Cascades of a forecast have room for the waves of both seas.
                    created = IsInTransition ? new Ocean(Sea, new[] { RestOfTransition() }, 0, ocean) : new Ocean(Target, ocean);
                }
            }
            catch (PelagicException exception)
            {
                needsOcean = false;
                Problems.Report(ref problem, exception.Message, this);
                return;
            }
            OnDisable();
            Ocean = created;
            if (!IsInTransition) Sea = Target;
            var info = Ocean.Info;
            for (var i = 0; i < textures.Length; ++i) textures[i] = new FrameTextures(info.Resolution, info.CascadeCount);
            if (Foam) Snapshots = FrameTextures.ArrayOf(info.Resolution, versions.Length, TextureFormat.RGBA32, true);
            Array.Clear(versions, 0, versions.Length);
            // A texel of displacement has 8 bytes; one of the others 4, and mipmaps add a third.
            var texels = (double)info.Resolution * info.Resolution;
            MemoryBytes = (long)(info.MemoryBytes + texels * (textures.Length * info.CascadeCount * (8 + 2 * 16 / 3.0) + (Foam ? versions.Length * 16 / 3.0 : 0)));
            shown = origin ?? (0, 0);
            Schedule();
        }

        private void Schedule()
        {
            if (origin != null) Ocean.SetOrigin(origin.Value.X, origin.Value.Z);
            Ocean.SetWaterFrame(applied.Water);
            if (applied.Spray)
            {
                var center = SprayCenter == null ? default : SprayCenter.position;
                Ocean.SetSprayCenter(center.x, -center.z);
            }
            Ocean.ScheduleInto(Time.timeAsDouble, textures[1 - drawn].Targets());
            isInFlight = true;
        }

        private void FollowOrigin()
        {
            double byX = shown.X - Frame.OriginXM, byZ = shown.Z - Frame.OriginZM;
            if (byX == 0 && byZ == 0) return;
            shown = (Frame.OriginXM, Frame.OriginZM);
            OriginShifted?.Invoke(new Vector3((float)byX, 0, -(float)byZ));
        }

        private void SetShaders()
        {
            for (var i = 0; i < Frame.CascadeCount; ++i)
            {
                var cascade = Frame.Cascade(i);
                cascades[i] = new Vector4((float)cascade.SideM, (float)cascade.Cosine, (float)cascade.Sine, cascade.SlopeRange);
            }
            Shader.SetGlobalTexture(displacementId, Displacement);
            Shader.SetGlobalTexture(slopesId, Slopes);
            Shader.SetGlobalTexture(momentsId, Moments);
            Shader.SetGlobalVectorArray(cascadesId, cascades);
            if (Snapshots != null) UploadSnapshots();
        }

        /// <summary>Uploads images that have changed, which they do about five times a second.</summary>
        private void UploadSnapshots()
        {
            var hasChanged = false;
            for (var i = 0; i < versions.Length; ++i)
            {
                int image = i / FoamCascades, index = i % FoamCascades;
                if (index >= Frame.CascadeCount) continue;
                var cascade = Frame.Cascade(index);
                var snapshots = cascade.SnapshotsRgba8(image);
                if (snapshots.IsEmpty || cascade.SnapshotsVersion(image) == versions[i]) continue;
                versions[i] = cascade.SnapshotsVersion(image);
                FrameTextures.Copy(cascade, snapshots, Snapshots, i);
                hasChanged = true;
            }
            if (hasChanged) Snapshots.Apply(false);
            Shader.SetGlobalTexture(snapshotsId, Snapshots);
        }

        private Sea SeaOfFields()
        {
            if (presetName != Preset || presetName == null) ReadPreset();
            var sea = preset;
            if (WindSpeedMps != 0) sea.WindSpeedMps = WindSpeedMps;
            sea.WindDirectionRad += OceanSystem.DirectionRad(WindTowardsDeg);
            // The library rejects a fetch beside a height or a period, unless it is the default.
            if (WaveHeightM != 0 || PeakPeriodS != 0) (sea.WaveHeightM, sea.PeakPeriodS, sea.FetchM) = (WaveHeightM, PeakPeriodS, Pelagic.Sea.Default.FetchM);
            if (SeaDepthM != 0) sea.DepthM = SeaDepthM;
            if (Choppiness != -1) sea.Choppiness = Choppiness;
            if (Lean != -1) sea.Lean = Lean == 0.6f ? 0.6 : Lean;  // the float is beyond the range
            if (Cascades != 0) sea.Cascades = Cascades;
            if (Resolution != 0) sea.Resolution = Resolution;
            if (Systems == null) return sea;
            var first = &sea.systems_0;
            foreach (var system in Systems)
            {
                if (system.HeightM == 0 || sea.system_count == MaxSystems) continue;
                first[sea.system_count] = WaveSystem.Default;
                system.Write(ref first[sea.system_count++]);
            }
            return sea;
        }

        private void ReadPreset()
        {
            (presetName, presetProblem, wasRead) = (Preset ?? "", null, false);
            try
            {
                preset = Pelagic.Sea.Preset(presetName);
            }
            catch (PelagicException exception)
            {
                presetProblem = exception.Message;
            }
        }

        // Seas have no padding.
        private static bool AreEqual(Sea a, Sea b) => new ReadOnlySpan<byte>(&a, sizeof(Sea)).SequenceEqual(new ReadOnlySpan<byte>(&b, sizeof(Sea)));
    }
}
