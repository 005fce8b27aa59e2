// What is in an export's EXR files, and what they say about themselves.
#pragma once

#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/encode/exr_file.hpp"
#include "pelagic/tools/export/image_files.hpp"

namespace pelagic::tools {

/// The file before it is bytes; it reads the frame when it is encoded. Bytes of maps are halves in it, their part of 255.
///
/// Attributes: `wrapmodes` and `framesPerSecond` as OpenEXR knows them; `pelagic:frame`, `pelagic:time_s`,
/// `pelagic:loop_period_s`, `pelagic:axes`, `pelagic:rows`; and of the map `pelagic:map`, `pelagic:cascade`, `pelagic:side_m`,
/// `pelagic:rotation_cosine`, `pelagic:rotation_sine`, `pelagic:channels`, as `pelagic:foam_c1:cascade` and so on where a part has layers.
ExrFile exr_file(const ImageFile& file, const Frame& frame, int number, const ExportOptions& options);

}  // namespace pelagic::tools
