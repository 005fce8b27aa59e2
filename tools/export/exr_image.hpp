// Contents and attributes of an export's EXR files.
#pragma once

#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/encode/exr_file.hpp"
#include "pelagic/tools/export/image_files.hpp"

namespace pelagic::tools {

/// Returns the description of an EXR file; `frame` must stay valid until the file is encoded.
/// Values of 8-bit maps are stored as halves, as fractions of 255.
///
/// Attributes: `wrapmodes` and `framesPerSecond` are standard attributes of OpenEXR. Others are
/// `pelagic:frame`, `pelagic:time_s`, `pelagic:loop_period_s`, `pelagic:axes`, `pelagic:rows`, and
/// for each map `pelagic:map`, `pelagic:cascade`, `pelagic:side_m`, `pelagic:rotation_cosine`,
/// `pelagic:rotation_sine`, `pelagic:channels`. If a part has several layers, the names contain the
/// layer: `pelagic:foam_c1:cascade`.
ExrFile exr_file(const ImageFile& file, const Frame& frame, int number, const ExportOptions& options);

}  // namespace pelagic::tools
