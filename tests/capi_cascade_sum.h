/* The sum of cascades that docs/api.md specifies, as a C application would write it. */
#ifndef PELAGIC_TESTS_CAPI_CASCADE_SUM_H
#define PELAGIC_TESTS_CAPI_CASCADE_SUM_H

#include <math.h>
#include <pelagic/pelagic.h>

/* Adds a cascade's slopes at the reference position (x, z), interpolated as a GPU's filter does:
 * h_x, h_z, D_xx, D_zz, D_xz, and the variances var_xx, var_zz, cov_xz. */
static inline void add_slopes(const pelagic_cascade* cascade, double x, double z, double sum[8]) {
    const int n = cascade->resolution;
    const double u = (cascade->cosine * x + cascade->sine * z) * n / cascade->side_m;
    const double v = (cascade->cosine * z - cascade->sine * x) * n / cascade->side_m;
    for (int part = 0; part < 32; ++part) {
        const int byte = part % 8; /* of one of the four texels around */
        const double i = floor(u) + part / 8 % 2, j = floor(v) + part / 16;
        const size_t texel = (size_t)((int64_t)j & (n - 1)) * (size_t)n + (size_t)((int64_t)i & (n - 1));
        const uint32_t word = (byte < 4 ? cascade->slopes_rgba8 : cascade->moments_rgba8)[texel];
        const int value = (int)(word >> byte % 4 * 8 & 255);
        const double range = byte < 5 ? cascade->slope_range : cascade->variance_range;
        const double amount = byte == 5 || byte == 6 ? value / 255.0 : (value - 128) / 127.0;
        sum[byte] += (1 - fabs(u - i)) * (1 - fabs(v - j)) * range * amount;
    }
}

/* The normal of the sum, of any length; normal[1] is the Jacobian. */
static inline void normal_of_slopes(const double sum[8], double normal[3]) {
    const double j_xx = 1 + sum[2], j_zz = 1 + sum[3], d_xz = sum[4];
    normal[0] = sum[1] * d_xz - sum[0] * j_zz;
    normal[1] = j_xx * j_zz - d_xz * d_xz;
    normal[2] = sum[0] * d_xz - sum[1] * j_xx;
}

#endif
