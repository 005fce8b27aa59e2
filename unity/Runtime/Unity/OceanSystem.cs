using System;
using UnityEngine;

namespace Pelagic.Unity
{
    /// <summary>Waves of one height, period and direction, in addition to those of an OceanBehaviour's wind.</summary>
    [Serializable]
    public struct OceanSystem
    {
        [Range(0, 30), Tooltip("Significant wave height in metres. 0: no waves.")]
        public float HeightM;
        [Range(0, 40), Tooltip("Peak period in seconds; 1 or more. 0: by the height.")]
        public float PeriodS;
        [Range(-180, 180), Tooltip("Direction that the waves run towards, as the y rotation of a transform, in degrees.")]
        public float TowardsDeg;
        [Range(0, 80), Tooltip("Standard deviation of the directions in degrees; 1 or more. 0: as measured in a wind sea.")]
        public float SpreadDeg;

        /// <summary>Direction of the sea, from +x towards +z, of a y rotation in the scene.</summary>
        internal static double DirectionRad(float towardsDeg) => (towardsDeg - 90.0) * Math.PI / 180;

        internal void Write(ref WaveSystem system)
        {
            system.HeightM = HeightM;
            system.PeakPeriodS = PeriodS;
            system.DirectionRad = DirectionRad(TowardsDeg);
            system.SpreadRad = SpreadDeg * Math.PI / 180;
        }
    }
}
