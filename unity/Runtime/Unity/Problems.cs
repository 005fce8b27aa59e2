using UnityEngine;

namespace Pelagic.Unity
{
    internal static class Problems
    {
        /// <summary>Logs a problem of a component as one line, unless it is the one reported last; null: no problem.</summary>
        internal static void Report(ref string last, string problem, MonoBehaviour component)
        {
            if (problem != null && problem != last) Debug.LogError($"{component.GetType().Name} '{component.name}': {problem}", component);
            last = problem;
        }
    }
}
