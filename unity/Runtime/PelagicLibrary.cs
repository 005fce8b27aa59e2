using System;

namespace Pelagic
{
    /// <summary>The native library.</summary>
    public static class PelagicLibrary
    {
        /// <summary>Version of the loaded library.</summary>
        public static Version Version
        {
            get
            {
                var number = (int)Native.pelagic_version();
                return new Version(number / 10000, number / 100 % 100, number % 100);
            }
        }

        /// <summary>
        /// Disposes all oceans, dynamic waves, inputs and executors of this application domain, after waiting for
        /// work in flight. Runs by itself before the domain is unloaded, for instance when Unity reloads scripts.
        /// </summary>
        public static void DisposeAll()
        {
            LiveHandles.DisposeAll();
        }
    }
}
