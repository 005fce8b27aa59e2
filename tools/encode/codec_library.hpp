// Loading of the tool's own shared libraries (image_codec.hpp, exr_codec.hpp), which keep large
// dependencies out of commands that do not need them.
#pragma once

namespace pelagic::tools {

/// Keeps dependencies from starting threads that have no work here: OpenImageIO may load OpenBLAS,
/// whose threads try to allocate memory until they succeed. Call it before other threads exist.
void keep_dependencies_single_threaded();

}  // namespace pelagic::tools
