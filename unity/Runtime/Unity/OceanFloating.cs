using UnityEngine;

namespace Pelagic.Unity
{
    /// <summary>
    /// Moves its transform as a hull that floats in the water of an OceanBehaviour with Depth. Each FixedUpdate()
    /// advances the hull by Time.fixedDeltaTime in the frame completed last. In an ocean with DynamicWaves it
    /// makes a wake. Where that frame has another origin than the one before, the hull moves to its place.
    ///
    /// The bow points along the transform's z axis. A component that moves a Rigidbody must not be on the same object.
    /// </summary>
    public sealed class OceanFloating : MonoBehaviour
    {
        public OceanBehaviour Ocean;
        /// <summary>The outer surface, closed, of 4 to 4096 triangles, unscaled. Read/Write must be enabled.</summary>
        public Mesh Mesh;
        public float MassKg = 1000;
        /// <summary>Force of engines and tow lines at the centre of mass, newtons, in the scene's axes.</summary>
        public Vector3 Force;

        /// <summary>The hull makes a wake if the ocean has dynamic waves. Takes effect when the component is enabled.</summary>
        public bool Wake = true;

        private OceanBehaviour pressed;
        private double unpressedS;
        private Hull hull;
        private Bodies bodies;
        private Ocean water;
        private uint number;
        private double originXM, originZM;

        /// <summary>The hull in the sea's axes, whose z axis is -z of the scene. Valid after the first step.</summary>
        public HullState State { get; private set; }

        private void FixedUpdate()
        {
            if (Ocean == null || !Ocean.HasFrame) return;
            if (water != Ocean.Ocean) Launch();
            FollowOrigin();
            bodies.SetInputs(number, new HullInputs { Force = new HullForce { ForceXN = Force.x, ForceYN = Force.y, ForceZN = -Force.z } });
            bodies.Step(Time.fixedDeltaTime);
            State = bodies.State(number);
            unpressedS += Time.fixedDeltaTime;
            Place(State);
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
            bodies.Shift(originXM - frame.OriginXM, originZM - frame.OriginZM);
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

        /// <summary>Launches the hull upright, where the transform is.</summary>
        private void Launch()
        {
            OnDisable();
            hull = HullOf(Mesh, MassKg);
            var hasWake = Wake && Ocean.Ocean.DynamicWaves != null;
            bodies = new Bodies(Ocean.Ocean, hasWake);
            var bow = transform.forward;
            var heading = System.Math.Atan2(-bow.z, bow.x);
            double cosine = System.Math.Cos(heading), sine = System.Math.Sin(heading);
            // AtRest() takes the centre of mass, and the transform is the mesh's origin.
            var info = hull.Info;
            number = bodies.Add(hull, hull.AtRest(transform.position.x + cosine * info.CentreOfMassXM - sine * info.CentreOfMassZM,
                                                  -transform.position.z + sine * info.CentreOfMassXM + cosine * info.CentreOfMassZM, heading));
            water = Ocean.Ocean;
            (originXM, originZM) = (Ocean.Frame.OriginXM, Ocean.Frame.OriginZM);
            unpressedS = 0;
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

        private void Place(in HullState state)
        {
            double x = state.OrientationX, y = state.OrientationY, z = state.OrientationZ, w = state.OrientationW;
            // Columns of the rotation: the hull's axes in the sea.
            double bowX = 1 - 2 * (y * y + z * z), bowY = 2 * (x * y + z * w), bowZ = 2 * (x * z - y * w);
            double upX = 2 * (x * y - z * w), upY = 1 - 2 * (x * x + z * z), upZ = 2 * (y * z + x * w);
            double starboardX = 2 * (x * z + y * w), starboardY = 2 * (y * z - x * w), starboardZ = 1 - 2 * (x * x + y * y);
            var info = hull.Info;
            double forward = info.CentreOfMassXM, above = info.CentreOfMassYM, starboard = info.CentreOfMassZM;
            var origin = new Vector3((float)(state.PositionXM - bowX * forward - upX * above - starboardX * starboard),
                                     (float)(state.PositionYM - bowY * forward - upY * above - starboardY * starboard),
                                     -(float)(state.PositionZM - bowZ * forward - upZ * above - starboardZ * starboard));
            var rotation = Quaternion.LookRotation(new Vector3((float)bowX, (float)bowY, -(float)bowZ), new Vector3((float)upX, (float)upY, -(float)upZ));
            transform.SetPositionAndRotation(origin, rotation);
        }
    }
}
