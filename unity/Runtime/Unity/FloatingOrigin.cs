using System.Collections.Generic;
using UnityEngine;

namespace Pelagic.Unity
{
    /// <summary>
    /// Keeps a viewer near the origin, where floats are fine: moves the origin of an ocean, and all root objects of this
    /// object's scene in the frame that has the new origin. Particles and trails in world space stay behind.
    /// </summary>
    public sealed class FloatingOrigin : MonoBehaviour
    {
        public OceanBehaviour Ocean;
        [Tooltip("Usually the camera or its rig. None: only Shift() moves the origin.")]
        public Transform Viewer;
        [Range(100, 100000), Tooltip("Distance of the viewer along x or z, in metres, at which the origin moves to it.")]
        public float DistanceM = 4000;

        private readonly List<GameObject> roots = new List<GameObject>();
        private OceanBehaviour followed;

        /// <summary>Moves the origin to a position of the scene, in one of the next frames. Its y has no effect.</summary>
        public void Shift(Vector3 position)
        {
            // Until the scene moves, its positions are relative to the origin of the frame.
            var frame = Ocean.Frame;
            Ocean.SetOrigin(frame.OriginXM + position.x, frame.OriginZM - position.z);
        }

        private void Update()
        {
            if (!ReferenceEquals(followed, Ocean)) Follow(Ocean);
            if (Ocean == null || Viewer == null || !Ocean.HasFrame) return;
            var at = Viewer.position;
            if (Mathf.Abs(at.x) > DistanceM || Mathf.Abs(at.z) > DistanceM) Shift(at);
        }

        private void OnDisable()
        {
            Follow(null);
        }

        private void Follow(OceanBehaviour ocean)
        {
            if (!ReferenceEquals(followed, null)) followed.OriginShifted -= Move;
            followed = ocean;
            if (!ReferenceEquals(followed, null)) followed.OriginShifted += Move;
        }

        private void Move(Vector3 by)
        {
            gameObject.scene.GetRootGameObjects(roots);
            foreach (var root in roots) root.transform.position += by;
            roots.Clear();
            Physics.SyncTransforms();  // rigid bodies follow their transforms before the next step
        }
    }
}
