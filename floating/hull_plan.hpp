// The lowest and the highest point of a hull above each cell of its plan.
#pragma once

#include <vector>

#include "pelagic/floating/hull_mesh.hpp"

namespace pelagic {

/// Heights over a rectangle around a mesh, in its axes. Cells are columns x rows, rows from port to
/// starboard (along z), the first column aft (along x).
struct HullPlan {
    int columns = 0, rows = 0;
    double x_m = 0, z_m = 0;          ///< middle of the rectangle
    double length_m = 0, beam_m = 0;  ///< along x and along z
    /// Mean lowest and highest points of the cell's verticals that meet the mesh; 0 without any.
    std::vector<float> low_m, high_m;
    std::vector<float> coverage;  ///< fraction of the cell's verticals that meet the mesh
};

/// Returns the plan of a mesh, from 4 x 4 verticals a cell.
/// \throws std::invalid_argument  if columns or rows are not in [1, 1024]
HullPlan plan_of(const HullMesh& mesh, int columns, int rows);

}  // namespace pelagic
