using System;
using UnityEngine;

namespace Pelagic.Unity
{
    /// <summary>
    /// A hull that floats in the water of an OceanBehaviour with Depth. Each FixedUpdate() advances it by
    /// Time.fixedDeltaTime in the frame completed last. In an ocean with DynamicWaves it makes a wake. Where that frame
    /// has another origin than the one before, the hull moves to its place.
    ///
    /// Without Body the component moves its transform, between steps too. With Body, a Rigidbody on this object, it changes the body's
    /// velocities by water, weight and Force, so that collisions, joints and forces of other components act, too; the
    /// water is then taken at the time of the step. The bow points along the transform's z axis.
    /// </summary>
    public sealed class OceanFloating : MonoBehaviour
    {
        // A longer extrapolation is worse than none: waves of 2 s turn in half a second.
        private const double MaxExtrapolationS = 0.25;

        public OceanBehaviour Ocean;
        [Tooltip("The outer surface, closed, of 4 to 4096 triangles, unscaled. Read/Write must be enabled.")]
        public Mesh Mesh;
        [Min(0), Tooltip("Mass in kg; (0, 1e10].")]
        public float MassKg = 1000;
        [Tooltip("Force of engines and tow lines at the centre of mass, newtons, in the scene's axes.")]
        public Vector3 Force;
        [Tooltip("The hull makes a wake if the ocean has dynamic waves.")]
        public bool Wake = true;
        [Tooltip("A Rigidbody of this object. None: the component moves the transform.")]
        public Rigidbody Body;

        private OceanBehaviour pressed;
        private double unpressedS;
        private Hull hull;
        private HullInfo info;
        private Bodies bodies;
        private Ocean water;
        private (Mesh Mesh, float MassKg, bool Wake, Rigidbody Body) launched;
        private string problem;
        private uint number;
        private double originXM, originZM;
        private (Vector3 Position, Quaternion Rotation) before, after;  // of the last step, without Body

        /// <summary>The hull in the sea's axes, whose z axis is -z of the scene. Valid after the first step.</summary>
        public HullState State { get; private set; }
        /// <summary>One line about why the hull does not float, or null.</summary>
        public string Problem => problem;

        private void FixedUpdate()
        {
            if (Ocean == null || !Ocean.HasFrame) return;
            if (water != Ocean.Ocean || launched.Mesh != Mesh || launched.MassKg != MassKg || launched.Wake != Wake || launched.Body != Body) TryLaunch();
            if (bodies == null) return;
            FollowOrigin();
            double stepS = Time.fixedDeltaTime;
            bodies.SetInputs(number, new HullInputs { Force = new HullForce { ForceXN = Force.x, ForceYN = Force.y, ForceZN = -Force.z } });
            unpressedS += stepS;
            if (Body == null)
            {
                bodies.Step(stepS);
                State = bodies.State(number);
                before = after;
                Place(State);
                transform.SetPositionAndRotation(after.Position, after.Rotation);
                return;
            }
            var began = StateOfBody();
            bodies.SetState(number, began);
            bodies.Step(stepS);
            State = bodies.State(number);
            // The step includes the weight.
            var gravity = Body.useGravity ? Physics.gravity : default;
            Body.AddForce(new Vector3((float)(State.VelocityXMps - began.VelocityXMps - gravity.x * stepS), (float)(State.VelocityYMps - began.VelocityYMps - gravity.y * stepS),
                                      (float)(began.VelocityZMps - State.VelocityZMps - gravity.z * stepS)),
                          ForceMode.VelocityChange);
            Body.AddTorque(new Vector3((float)(began.AngularVelocityXRadps - State.AngularVelocityXRadps), (float)(began.AngularVelocityYRadps - State.AngularVelocityYRadps),
                                       (float)(State.AngularVelocityZRadps - began.AngularVelocityZRadps)),
                           ForceMode.VelocityChange);
        }

        /// <summary>Shows the hull between its last two steps, as an interpolated Rigidbody.</summary>
        private void Update()
        {
            if (bodies == null || Body != null || Ocean == null || !Ocean.HasFrame) return;
            FollowOrigin();
            var fraction = (float)((Time.timeAsDouble - Time.fixedTimeAsDouble) / Time.fixedDeltaTime);
            transform.SetPositionAndRotation(Vector3.Lerp(before.Position, after.Position, fraction), Quaternion.Slerp(before.Rotation, after.Rotation, fraction));
        }

        /// <summary>
        /// The state of Body, with what the library keeps of the preceding step. The frame is that of another time: the hull
        /// has the height above its water, and the velocity relative to it, that it has in the water of the step, by first
        /// derivatives.
        /// </summary>
        private HullState StateOfBody()
        {
            var state = bodies.State(number);
            var loads = bodies.Loads(number);
            var rise = loads.WaterVelocityYMps - loads.WaterVelocityXMps * loads.WaterSlopeX - loads.WaterVelocityZMps * loads.WaterSlopeZ;
            var laterS = Math.Max(-MaxExtrapolationS, Math.Min(Time.fixedTimeAsDouble - Ocean.Frame.TimeS, MaxExtrapolationS));
            Vector3 centre = Body.worldCenterOfMass, velocity = Body.GetPointVelocity(centre), turn = Body.angularVelocity;
            (state.PositionXM, state.PositionYM, state.PositionZM) = (centre.x, centre.y - rise * laterS, -centre.z);
            (state.VelocityXMps, state.VelocityYMps, state.VelocityZMps) =
                (velocity.x - loads.WaterAccelerationXMps2 * laterS, velocity.y - loads.WaterAccelerationYMps2 * laterS, -velocity.z - loads.WaterAccelerationZMps2 * laterS);
            // Axes of rotations are pseudovectors: a reflection changes their other components.
            (state.AngularVelocityXRadps, state.AngularVelocityYRadps, state.AngularVelocityZRadps) = (-turn.x, -turn.y, turn.z);
            // (-x, -y, z, w) in the sea's axes, times the quarter turn from the hull's axes to starboard, up and astern.
            var q = Body.rotation;
            double x = q.x, y = q.y, z = q.z, w = q.w, scale = 1 / Math.Sqrt(2 * (x * x + y * y + z * z + w * w));
            (state.OrientationX, state.OrientationY, state.OrientationZ, state.OrientationW) = (-scale * (x + z), scale * (w - y), scale * (z - x), scale * (w + y));
            return state;
        }

        /// <summary>Moves the wake's pressure along the steps since the last frame.</summary>
        private void Press()
        {
            FollowOrigin();
            if (unpressedS == 0) return;  // as in the frames of a new ocean before the hull is launched in it
            bodies.Press(unpressedS);
            unpressedS = 0;
        }

        private void FollowOrigin()
        {
            var frame = Ocean.Frame;
            if (frame.OriginXM == originXM && frame.OriginZM == originZM) return;
            double byX = originXM - frame.OriginXM, byZ = originZM - frame.OriginZM;
            bodies.Shift(byX, byZ);
            var by = new Vector3((float)byX, 0, -(float)byZ);
            before.Position += by;
            after.Position += by;
            (originXM, originZM) = (frame.OriginXM, frame.OriginZM);
        }

        private void OnDisable()
        {
            if (!ReferenceEquals(pressed, null)) pressed.BetweenFrames -= Press;
            pressed = null;
            bodies?.Dispose();
            hull?.Dispose();
            bodies = null;
            hull = null;
            water = null;
        }

        /// <summary>Launches the hull, or reports why not and waits for a change of fields or ocean.</summary>
        private void TryLaunch()
        {
            OnDisable();
            water = Ocean.Ocean;
            launched = (Mesh, MassKg, Wake, Body);
            var message = Mesh == null ? "Mesh is none, expected the outer surface of a hull"
                : !Mesh.isReadable ? $"Mesh '{Mesh.name}' is not readable, expected Read/Write enabled in its import settings"
                : !Ocean.Depth ? $"OceanBehaviour '{Ocean.name}' has no Depth, which a hull needs" : null;
            try
            {
                if (message == null) Launch();
            }
            catch (PelagicException exception)
            {
                message = exception.Message;
            }
            Problems.Report(ref problem, message, this);
        }

        /// <summary>Launches the hull upright, where the transform is.</summary>
        private void Launch()
        {
            hull = HullOf(Mesh, MassKg);
            info = hull.Info;
            var hasWake = Wake && Ocean.Ocean.DynamicWaves != null;
            var bow = transform.forward;
            var heading = Math.Atan2(-bow.z, bow.x);
            double cosine = Math.Cos(heading), sine = Math.Sin(heading);
            // AtRest() takes the centre of mass, and the transform is the mesh's origin.
            var rest = hull.AtRest(transform.position.x + cosine * info.CentreOfMassXM - sine * info.CentreOfMassZM,
                                   -transform.position.z + sine * info.CentreOfMassXM + cosine * info.CentreOfMassZM, heading);
            var set = new Bodies(Ocean.Ocean, hasWake);
            number = set.Add(hull, rest);
            bodies = set;
            (originXM, originZM) = (Ocean.Frame.OriginXM, Ocean.Frame.OriginZM);
            unpressedS = 0;
            Place(rest);
            before = after;
            if (Body != null)
            {
                Body.mass = MassKg;
                Body.centerOfMass = new Vector3((float)info.CentreOfMassZM, (float)info.CentreOfMassYM, (float)info.CentreOfMassXM);
            }
            if (!hasWake) return;
            pressed = Ocean;
            pressed.BetweenFrames += Press;
        }

        /// <summary>
        /// The hull's axes are forward, up and starboard, those of the mesh starboard, up and forward. The exchange is
        /// a reflection, and Unity's triangles are clockwise: their corners are reversed, too.
        /// </summary>
        private static Hull HullOf(Mesh mesh, double massKg)
        {
            var vertices = mesh.vertices;
            var numbers = mesh.triangles;
            var verticesM = new double[3 * vertices.Length];
            for (var i = 0; i < vertices.Length; ++i)
            {
                verticesM[3 * i] = vertices[i].z;
                verticesM[3 * i + 1] = vertices[i].y;
                verticesM[3 * i + 2] = vertices[i].x;
            }
            var triangles = new uint[numbers.Length];
            for (var i = 0; i < numbers.Length; ++i) triangles[i] = (uint)numbers[numbers.Length - 1 - i];
            return new Hull(verticesM, triangles, new HullOptions(massKg));
        }

        /// <summary>Computes the transform of a state.</summary>
        private void Place(in HullState state)
        {
            double x = state.OrientationX, y = state.OrientationY, z = state.OrientationZ, w = state.OrientationW;
            // Columns of the rotation: the hull's axes in the sea.
            double bowX = 1 - 2 * (y * y + z * z), bowY = 2 * (x * y + z * w), bowZ = 2 * (x * z - y * w);
            double upX = 2 * (x * y - z * w), upY = 1 - 2 * (x * x + z * z), upZ = 2 * (y * z + x * w);
            double starboardX = 2 * (x * z + y * w), starboardY = 2 * (y * z - x * w), starboardZ = 1 - 2 * (x * x + y * y);
            double forward = info.CentreOfMassXM, above = info.CentreOfMassYM, starboard = info.CentreOfMassZM;
            var origin = new Vector3((float)(state.PositionXM - bowX * forward - upX * above - starboardX * starboard),
                                     (float)(state.PositionYM - bowY * forward - upY * above - starboardY * starboard),
                                     -(float)(state.PositionZM - bowZ * forward - upZ * above - starboardZ * starboard));
            var rotation = Quaternion.LookRotation(new Vector3((float)bowX, (float)bowY, -(float)bowZ), new Vector3((float)upX, (float)upY, -(float)upZ));
            after = (origin, rotation);
        }
    }
}
