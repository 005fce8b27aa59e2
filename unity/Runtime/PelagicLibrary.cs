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

        /// <summary>Null if the library can be used, else one line about why not.</summary>
        public static string Problem()
        {
            try
            {
                var version = Version;
                if (version.Major == Native.VersionMajor && version.Minor >= Native.VersionMinor) return null;
                return $"pelagic_c has version {version}, expected {Native.VersionMajor}.{Native.VersionMinor} or a later {Native.VersionMajor}.x";
            }
            catch (DllNotFoundException)
            {
                return "pelagic_c was not found, expected in Plugins of the package for this platform; unity/pack.py puts it there";
            }
            catch (Exception exception) when (exception is EntryPointNotFoundException || exception is BadImageFormatException)
            {
                return "pelagic_c is no library of Pelagic for this processor";
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
