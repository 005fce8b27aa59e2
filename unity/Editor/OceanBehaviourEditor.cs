using UnityEditor;
using UnityEngine;

namespace Pelagic.Unity
{
    /// <summary>The fields of an OceanBehaviour, and a box with statistics of its sea or the first problem.</summary>
    [CustomEditor(typeof(OceanBehaviour))]
    public sealed class OceanBehaviourEditor : Editor
    {
        private Sea described;
        private Statistics statistics;
        private string sea;

        /// <summary>Times change while the scene runs.</summary>
        public override bool RequiresConstantRepaint() => Application.isPlaying;

        public override void OnInspectorGUI()
        {
            DrawDefaultInspector();
            var problem = PelagicLibrary.Problem();
            if (problem != null) EditorGUILayout.HelpBox(problem, MessageType.Error);
            else ShowSea((OceanBehaviour)target);
        }

        private void ShowSea(OceanBehaviour behaviour)
        {
            var wanted = behaviour.Target;
            var problem = behaviour.Ocean == null ? behaviour.Check(out wanted) : behaviour.Problem;
            if (problem != null) EditorGUILayout.HelpBox(problem, MessageType.Error);
            if (behaviour.Ocean == null && problem != null) return;
            if (sea == null || !described.Equals(wanted))
            {
                // As long as an ocean takes to create: once for each sea.
                statistics = wanted.Statistics();
                described = wanted;
                sea = $"Hs {statistics.ExpectedWaveHeightM:0.00} m, Tp {statistics.ExpectedPeakPeriodS:0.0} s, repeats after {statistics.RepeatsAfterM:0} m";
            }
            var times = $"{behaviour.UpdateMs:0.00} ms a frame on the main thread, {behaviour.WaitMs:0.00} ms of them waiting";
            EditorGUILayout.HelpBox(behaviour.HasFrame ? $"{sea}\n{times}\n{behaviour.MemoryBytes / 1e6:0.0} MB" : sea, MessageType.Info);
        }
    }
}
