// Counted glints of the sun. A pixel near the eye holds a few glints of the waves that it does not
// resolve, not their mean, so glitter sparkles.
//
// Cells of a grid on the water hold facets with random thresholds. A facet reflects the sun if its
// threshold is below the probability. The mean over all thresholds is the smooth distribution.
// Thresholds depend on the undisplaced position in the world and on the size of the footprint.
// Glints are therefore stable in time, and both eyes see the same ones.
//
// Zirr and Kaplanyan 2016, "Real-time Rendering of Procedural Multiscale Materials"; Deliot and
// Belcour 2023, "Real-Time Rendering of Glinty Appearances using Distributed Binomial Laws on
// Anisotropic Grids".
#if SHADING != HEADSET && !defined(SKIRT)
#define COUNTED_GLINTS

// Glints a square metre where the mean facet mirrors the sun: k^2 / (2 sqrt(3) pi) specular points,
// as of random waves with the wave number k (Longuet-Higgins 1960, "Reflection and refraction at a
// random moving surface"). Waves of 17 mm are the slowest; shorter ones are damped.
const float glint_wave_m = 0.017;
const float glints_per_m2 = 3.63 / (glint_wave_m * glint_wave_m);
// Footprints over which ripples are filtered (waves.glsl), and so their glints.
const float glint_footprints = 2.5;
const int glint_cells = 4;
const vec2 glint_cell_at[glint_cells] = vec2[](vec2(-0.25, 0.75), vec2(0.75, 0.25), vec2(0.25, -0.75), vec2(-0.75, -0.25));
const float glint_facets = 16.0;  // four in each cell

// Returns the hash of a cell (Wellons 2018, "Prospecting for Hash Functions", lowbias32).
uint glint_hash(ivec2 cell, int level) {
    uint bits = uint(cell.x) * 0x8da6b343u + uint(cell.y) * 0xd8163841u + uint(level) * 0xcb1ab31fu;
    bits = (bits ^ (bits >> 16u)) * 0x7feb352du;
    bits = (bits ^ (bits >> 15u)) * 0x846ca68bu;
    return bits ^ (bits >> 16u);
}

// Returns thresholds in (0, 1) of the four facets of a cell.
vec4 glint_thresholds(ivec2 cell, int level) {
    uint bits = glint_hash(cell, level);
    return (vec4(uvec4(bits, bits >> 8u, bits >> 16u, bits >> 24u) & 255u) + 0.5) / 256.0;
}

// Returns the cell that contains a position; a cell of a level is 2^level metres wide.
ivec2 glint_cell(vec2 place, int level) {
    return ivec2(floor(place * uintBitsToFloat(uint(127 - level) << 23u))) + (ivec2(glint_place.zw) << (6 - level));
}

// Returns the number of glints in a footprint over its mean. The number is binomial if the mean is
// small, and Gaussian with the variance of Poisson's distribution if it is large.
float counted_glints(vec2 at, vec2 dx, vec2 dy, float mean) {
    // Cells are 0.7 to 1.4 sides of the footprint. A quarter of them at a time changes to the
    // next level, at distances that differ between squares of 4 cells: a change along a row of the
    // image would show.
    float fine = log2(clamp(sqrt(min(dot(dx, dx), dot(dy, dy))), 1e-3, 8.0)) + 1.0, whole = floor(fine);
    float probability = min(mean / glint_facets, 1.0);
    vec2 place = at + glint_place.xy;
    int wide = int(whole) + 2;
    float next = fine - whole + 0.25 * (float(glint_hash(glint_cell(place, wide), wide) >> 8u) / 16777216.0 - 0.5);
    float count = 0.0, sum = 0.0;
    for (int i = 0; i < glint_cells; ++i) {
        int level = int(whole) - (next < 0.25 * (float(i) + 0.5) ? 1 : 0);
        ivec2 cell = glint_cell(place + dx * glint_cell_at[i].x + dy * glint_cell_at[i].y, level);
        vec4 thresholds = glint_thresholds(cell, level);
        count += dot(clamp((probability - thresholds) * 256.0 + 0.5, 0.0, 1.0), vec4(1.0));
        sum += dot(thresholds, vec4(1.0));
    }
    float few = count / (glint_facets * max(probability, 1e-7));
    // The sum of 16 uniform numbers has the variance 4 / 3.
    float many = max(1.0 + (sum - 8.0) * 0.8660254 * inversesqrt(max(mean, 1.0)), 0.0);
    return mix(few, many, smoothstep(5.0, 10.0, mean));
}

// Returns glint() with counted glints. `at` is the undisplaced position; dx and dy are the sides of
// the footprint. Of alpha2, `ripples` is that of the waves that glint. Slopes of all others blur a
// glint. For Gaussian slopes this divides the variance of a pixel's light as by more glints, most
// of all in the lobe's tail.
float sparkling_glint(vec2 at, vec2 dx, vec2 dy, vec3 normal, vec3 to_eye, float alpha2, float ripples) {
    float smooth_glint = glint(normal, to_eye, alpha2);
    float blur = max(alpha2 - ripples, 0.0);
    float overlapping = (ripples + blur) * (ripples + 2.0 * blur) / max(ripples * ripples, 1e-12);
    float most = glints_per_m2 * glint_footprints * abs(dx.x * dy.y - dx.y * dy.x) * overlapping;
    float cosine2 = clamp(dot(normal, normalize(sun.xyz + to_eye)), 1e-3, 1.0);
    cosine2 *= cosine2;
    float mean = most * exp((cosine2 - 1.0) / (cosine2 * alpha2) * 2.0 * ripples / (2.0 * ripples + blur));
    if (smooth_glint <= 0.0 || mean > 1e3) return smooth_glint;
    return smooth_glint * mix(counted_glints(at, dx, dy, mean), 1.0, smoothstep(300.0, 1000.0, mean));
}
#endif
