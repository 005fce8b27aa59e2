// Bounds of displacements. Objects that are compiled once per instruction set include this header,
// so it includes no other.
#pragma once

namespace pelagic {

/// Extremes of displacements, for culling boxes: of a frame, a cascade or a part of one. The
/// heights are relative to still water.
struct FrameBounds {
    float height_min_m = 0;
    float height_max_m = 0;
    float horizontal_x_max_m = 0;  ///< largest |Dx|
    float horizontal_z_max_m = 0;  ///< largest |Dz|

    /// Adds the bounds of waves that are added to these.
    FrameBounds& operator+=(const FrameBounds& added) {
        height_min_m += added.height_min_m;
        height_max_m += added.height_max_m;
        horizontal_x_max_m += added.horizontal_x_max_m;
        horizontal_z_max_m += added.horizontal_z_max_m;
        return *this;
    }
    /// Extends the bounds by those of another area. The result does not depend on the order of
    /// areas.
    void extend(const FrameBounds& other) {
        if (other.height_min_m < height_min_m) height_min_m = other.height_min_m;
        if (other.height_max_m > height_max_m) height_max_m = other.height_max_m;
        if (other.horizontal_x_max_m > horizontal_x_max_m) horizontal_x_max_m = other.horizontal_x_max_m;
        if (other.horizontal_z_max_m > horizontal_z_max_m) horizontal_z_max_m = other.horizontal_z_max_m;
    }
};

}  // namespace pelagic
