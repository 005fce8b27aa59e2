// Loading of the tool's own shared libraries, which keep large dependencies out of commands that do
// not need them.
#pragma once

#include <cstddef>

namespace pelagic::tools {

/// Describes a library that exports a table of functions. The first member of the table is
/// `const char* version`, which must equal the tool's version.
struct CodecLibrary {
    const char* file;   ///< without a folder
    const char* use;    ///< completes "FILE, which ..." in messages
    const char* table;  ///< name of the exported table
    /// Threads and bytes of address space that the dependencies need during loading. If the system
    /// refuses them then, the process may crash or hang, so they are requested first.
    int threads;
    std::size_t address_space;
};

/// Keeps dependencies from starting threads that have no work here: OpenImageIO may load OpenBLAS,
/// whose threads try to allocate memory until they succeed. Call it before other threads exist.
void keep_dependencies_single_threaded();

/// Loads the library from its path relative to the tool and returns its table. The library is never
/// unloaded. Throws FileError that names the library file.
const void* load_table(const CodecLibrary& library);

}  // namespace pelagic::tools
