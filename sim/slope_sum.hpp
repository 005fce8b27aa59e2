// Slopes of a cascade's maps, which add over cascades, and the normal and Jacobian of their sum.
//
// The normal and Jacobian of a sum of cascades are not the sums of theirs, but the derivatives are.
// So rendering and queries add the derivatives of all cascades at a point and compute the normal of
// the sum. Filters and mipmaps may be applied before the sum, because they are linear. Shaders do
// this too.
#pragma once

#include <cstdint>

namespace pelagic {

/// Ranges that the bytes of a cascade's slope maps cover.
struct SlopeRanges {
    float slope = 1;     ///< of h_x, h_z, D_xx, D_zz, D_xz
    float variance = 1;  ///< of h_x and h_z within a texel
};

/// Derivatives of a surface along the world's x and z at the undisplaced position, of a cascade
/// or of a sum.
struct SurfaceSlopes {
    double h_x = 0, h_z = 0;              ///< of the height
    double d_xx = 0, d_zz = 0, d_xz = 0;  ///< of the horizontal displacement; Dx,z = Dz,x
    /// Covariance of h_x and h_z within the texel; cascades are independent.
    double var_xx = 0, var_zz = 0, cov_xz = 0;

    /// Adds the derivatives and their moments of another cascade.
    SurfaceSlopes& operator+=(const SurfaceSlopes& other) {
        h_x += other.h_x;
        h_z += other.h_z;
        d_xx += other.d_xx;
        d_zz += other.d_zz;
        d_xz += other.d_xz;
        var_xx += other.var_xx;
        var_zz += other.var_zz;
        cov_xz += other.cov_xz;
        return *this;
    }
};

/// Decodes a texel of both maps, bytes from the lowest up: h_x, h_z, D_xx, D_zz; D_xz, var_xx,
/// var_zz, cov_xz. Variances are b/255 of their range, all others (b - 128)/127. With a texture's v
/// = b/255 these are v and v 255/127 - 128/127.
inline SurfaceSlopes slopes_of_texel(std::uint32_t slopes, std::uint32_t moments, const SlopeRanges& ranges) {
    const auto byte = [](std::uint32_t word, int number) { return static_cast<double>(word >> 8 * number & 0xFF); };
    const auto around_zero = [&](std::uint32_t word, int number) { return (byte(word, number) - 128) / 127; };
    return {.h_x = around_zero(slopes, 0) * ranges.slope,
            .h_z = around_zero(slopes, 1) * ranges.slope,
            .d_xx = around_zero(slopes, 2) * ranges.slope,
            .d_zz = around_zero(slopes, 3) * ranges.slope,
            .d_xz = around_zero(moments, 0) * ranges.slope,
            .var_xx = byte(moments, 1) / 255 * ranges.variance,
            .var_zz = byte(moments, 2) / 255 * ranges.variance,
            .cov_xz = around_zero(moments, 3) * ranges.variance};
}

/// An unnormalised normal, N of VR Ocean's equations 47 and 48: the cross product of the tangents
/// (D_xz, h_z, 1 + D_zz) and (1 + D_xx, h_x, D_xz). `y` is the Jacobian.
struct SurfaceNormal {
    double x, y, z;
};
/// Returns the normal of the summed surface, not normalised; y is the Jacobian.
inline SurfaceNormal normal_of(const SurfaceSlopes& sum) {
    const double j_xx = 1 + sum.d_xx, j_zz = 1 + sum.d_zz;
    return {sum.h_z * sum.d_xz - sum.h_x * j_zz, j_xx * j_zz - sum.d_xz * sum.d_xz,
            sum.h_x * sum.d_xz - sum.h_z * j_xx};
}

}  // namespace pelagic
