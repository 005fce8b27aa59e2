using System.Runtime.CompilerServices;

// Jobs call the C interface itself, with pointers.
[assembly: InternalsVisibleTo("Pelagic.Unity")]
