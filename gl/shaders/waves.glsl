// Normal and roughness of a pixel of the surface, from the mips of the cascades' slopes and from
// ripples smaller than a texel.
//
// VR Ocean, equations 47 and 48 (the normal); Olano and Baker 2010, "LEAN Mapping".
uniform highp sampler2DArray slopes;   // per cascade: h_x, h_z, D_xx, D_zz (sim/slope_sum.hpp)
uniform highp sampler2DArray moments;  // D_xz, variance of h_x, variance of h_z, covariance
uniform sampler2D detail;              // ripple slopes, noise, resolved fraction of the slopes

// Footprint of a pixel on the sea, metres at undisplaced positions.
//
// Near the horizon the footprint is long and narrow, and a square mip would blur all waves in it.
// It is therefore sampled at four points of a rotated square over 1.33 of its sides. Unlike
// anisotropic filters this is identical on every driver.
//
// Each sample takes a mip half as wide as the footprint. A mip as wide as the footprint averages
// 2 x 2 texels, which aliases waves of three texels with half their height; a glint would show them
// as a woven pattern.
struct Footprint {
    vec2 dx, dy;   // along the image's row and column
    float wide_m;  // width of a sample
};

#if SHADING == HIGH
const int sample_count = 4;
const vec2 sample_places[sample_count] = vec2[](vec2(-0.167, 0.5), vec2(0.5, 0.167), vec2(0.167, -0.5), vec2(-0.5, -0.167));

#endif

Footprint footprint_of(vec2 at) {
    vec2 dx = dFdx(at), dy = dFdy(at);
    float x2 = dot(dx, dx), y2 = dot(dy, dy);
    float longest = max(sqrt(max(x2, y2)), 1e-6);
#if SHADING == HIGH
    return Footprint(dx, dy, max(0.5 * sqrt(min(x2, y2)), 0.25 * longest));
#else
    // One sample, as wide as the geometric mean of the footprint's sides.
    return Footprint(dx, dy, max(sqrt(sqrt(x2 * y2)), 0.25 * longest));
#endif
}

// Derivatives of the surface along undisplaced world x and z, and the mean square of the slopes
// that the pixel averages away.
struct Slopes {
    vec2 h;          // derivatives of the height
    vec3 d;          // derivatives of the horizontal displacement: D_xx, D_zz, D_xz
    float variance;  // variance of h, summed over both axes
};

// Signed bytes: 128 is zero.
const float signed_scale = 255.0 / 127.0, signed_zero = 128.0 / 127.0;

// Returns a cascade's texture coordinates of a pixel.
//
// Where many periods of a cascade are in view, its waves visibly repeat. Places in both coarser
// cascades are therefore displaced along the wind, beyond one side of the coarsest and two of the
// next, but not within 700 m of low viewers, where waves of the mesh hide each other. Viewers above
// 300 m see many periods at once. The sum of four sines, with 10 to 12 waves in the period of
// cascade_noise, differs from period to period by more than a quarter of the waves that show. It
// changes wavelengths by about a tenth, and moves foam with the waves.
vec2 place_of_pixel(int cascade, vec2 at, float distance_m) {
    vec2 uv = place_in_cascade(cascade, at);
#if CASCADES > 1
    if (cascade > 1) return uv;
    float far = smoothstep(1.0, 2.0, (distance_m + 1.5 * max(viewer.z, 0.0)) /
                                     max(float(cascade + 1) * cascade_scale[cascade].z, 700.0));
    if (far <= 0.0) return uv;
    vec2 turns = cascade_noise[cascade].xy + rotated_into_cascade(cascade, at) * cascade_noise[cascade].z;
    vec4 bends = sin(6.2831853 * (vec4(12.0, 3.0, -2.0, -10.0) * turns.x + vec4(2.0, 10.0, 12.0, 3.0) * turns.y));
    uv += rotated_into_cascade(cascade, waves.zw) * (cascade_scale[cascade].z * far * 0.02 * dot(bends, vec4(1.0)));
#endif
    return uv;
}

#if SHADING == HIGH
// Returns the sides of a footprint, clamped to at least a texel and at most one period of the
// texture.
mat2 sides_of(Footprint pixel, float texel_m, float tile_m) {
    vec2 lengths = vec2(max(length(pixel.dx), 1e-6), max(length(pixel.dy), 1e-6));
    vec2 scale = clamp(lengths, texel_m, tile_m) / lengths;
    return mat2(pixel.dx * scale.x, pixel.dy * scale.y);
}

// Offsets that vary the copies of a periodic texture.
//
// If there is only one cascade, its periods form a visible pattern in the distance. Sums of
// cascades do not repeat visibly. Far from the eye, samples are therefore taken at offset texture
// coordinates. A smooth noise selects two successive offsets of a sequence, and their samples are
// blended. Both belong to the same random process, so weights whose squares sum to one preserve its
// statistics (Heitz and Neyret 2018, "High-Performance By-Example Noise using a
// Histogram-Preserving Blending Operator"; slopes are already Gaussian).
struct Copies {
    vec2 first, second;  // offsets of texture coordinates
    vec2 weights;
    bool are_one;        // near the eye: both offsets are equal
};

Copies copies_along(float noise) {
    float first = floor(noise), second = smoothstep(0.0, 1.0, noise - first);
    // The R2 sequence (Roberts 2018), whose points are well separated.
    const vec2 to_next = vec2(0.7548777, 0.5698403);
    return Copies(fract(first * to_next), fract((first + 1.0) * to_next), sqrt(clamp(vec2(1.0 - second, second), 0.0, 1.0)), false);
}

Copies copies_at(int cascade, vec2 at, float distance_m) {
    float fraction = CASCADES == 1 ? smoothstep(3.0, 12.0, distance_m / cascade_scale[cascade].z) : 0.0;
    if (fraction <= 0.0) return Copies(vec2(0.0), vec2(0.0), vec2(0.5), true);
    vec2 uv = cascade_noise[cascade].xy + rotated_into_cascade(cascade, at) * cascade_noise[cascade].z;
    return copies_along(fraction * 16.0 * (textureLod(detail, uv, 5.0).z - 0.5));
}

vec4 slopes_at_sample(int i, int cascade, vec2 uv, mat2 sides, float mip) {
    return textureLod(slopes, vec3(uv + sides * sample_places[i], cascade), mip) * signed_scale - signed_zero;
}

// Returns a cascade's slopes in a footprint whose sides are given in texture coordinates. The
// variance between the samples counts as averaged away.
Slopes slopes_in_footprint(int cascade, vec2 uv, mat2 sides, float mip, Copies copies) {
    vec4 a = slopes_at_sample(0, cascade, uv + copies.first, sides, mip), b = slopes_at_sample(2, cascade, uv + copies.first, sides, mip);
    vec4 c = slopes_at_sample(1, cascade, uv + copies.second, sides, mip), d = slopes_at_sample(3, cascade, uv + copies.second, sides, mip);
    vec4 first = 0.5 * (a + b), second = 0.5 * (c + d);
    vec4 sum = copies.weights.x * first + copies.weights.y * second;
    vec2 apart = vec2(dot(a.xy - b.xy, a.xy - b.xy), dot(c.xy - d.xy, c.xy - d.xy)) / 4.0;
    float scatter = copies.are_one ? 0.5 * (apart.x + apart.y) + dot(first.xy - second.xy, first.xy - second.xy) / 4.0
                                   : dot(copies.weights * copies.weights, apart);
    vec4 moment = textureLod(moments, vec3(uv + copies.first, cascade), mip);
    float range = cascade_slope[cascade].x;
    return Slopes(sum.xy * range, vec3(sum.zw, moment.x * signed_scale - signed_zero) * range,
                  scatter * range * range + (moment.y + moment.z) * cascade_slope[cascade].y);
}

// Returns a cascade's slopes in a pixel. If the pixel resolves no wave of the cascade, all of them
// count as roughness, and no texture is sampled.
Slopes cascade_slopes(int cascade, vec2 at, float distance_m, Footprint pixel) {
    float mip = log2(pixel.wide_m * cascade_scale[cascade].x);
    float weight = weight_of_cascade(cascade, mip + 1.0);
    float all = cascade_slope[cascade].z;
    if (weight <= 0.0) return Slopes(vec2(0.0), vec3(0.0), all);
    mat2 sides = sides_of(pixel, 1.0 / cascade_scale[cascade].x, cascade_scale[cascade].z);
    Slopes seen = slopes_in_footprint(cascade, place_of_pixel(cascade, at, distance_m), mat2(rotated_into_cascade(cascade, sides[0]), rotated_into_cascade(cascade, sides[1])), mip,
                               copies_at(cascade, at, distance_m));
    return Slopes(weight * seen.h, weight * seen.d, mix(all, seen.variance, weight * weight));
}
#else
// Returns a cascade's slopes from one sample. The moments give the variance that the pixel averages
// away. Headsets omit that sample and estimate the variance from the fraction of octaves, between a
// texel and the longest waves, that the mip does not resolve. Each octave of wind waves has about
// the same slope variance.
Slopes cascade_slopes(int cascade, vec2 at, float distance_m, Footprint pixel) {
    float mip = log2(pixel.wide_m * cascade_scale[cascade].x);
    vec3 uv = vec3(place_of_pixel(cascade, at, distance_m), cascade);
    float weight = weight_of_cascade(cascade, mip);
    float all = cascade_slope[cascade].z, range = cascade_slope[cascade].x;
    vec4 texel = (textureLod(slopes, uv, mip) * signed_scale - signed_zero) * (weight * range);
#if SHADING == MEDIUM
    vec4 moment = textureLod(moments, uv, mip);
    return Slopes(texel.xy, vec3(texel.zw, (moment.x * signed_scale - signed_zero) * (weight * range)),
                  mix(all, (moment.y + moment.z) * cascade_slope[cascade].y, weight * weight));
#else
    return Slopes(texel.xy, vec3(texel.zw, 0.0), all * clamp(mip / cascade_scale[cascade].y, 0.0, 1.0));
#endif
}
#endif

// VR Ocean, equation 48: y of the normal.
float jacobian_of(vec3 d) { return (1.0 + d.x) * (1.0 + d.y) - d.z * d.z; }

// Returns the normal of the sum of all cascades as world slopes: x and z over y, at most 4.9.
vec2 normal_slopes(Slopes sum) {
    vec3 normal = vec3(sum.h.y * sum.d.z - sum.h.x * (1.0 + sum.d.y), jacobian_of(sum.d),
                       sum.h.x * sum.d.z - sum.h.y * (1.0 + sum.d.x));
    return normal.xz / max(normal.y, 0.2 * length(normal));
}

#ifdef SHORE
#include "shore_in_pixel.glsl"
#endif

struct Waves {
    vec2 slopes;   // with the sign of the normal
    float alpha2;  // alpha^2: mean square of the slopes that the pixel does not resolve
    float ripples;  // of these, the mean square of ripples
    // Fraction of the pixel that foam of small water or of dynamic waves covers.
    float crests;
    float compression;  // of the cascades, in standard deviations (snapshot_foam.glsl)
};

#if VERTEX_CASCADES > 0
// The coarsest cascade's waves are long, so headsets sample them per vertex.
Slopes slopes_of_vertices() {
#ifdef SKIRT
    return Slopes(vec2(0.0), vec3(0.0), cascade_slope[0].z);
#else
    return Slopes(coarsest.xy, vec3(coarsest.zw, 0.0), 0.0);
#endif
}
#endif

Waves resolved_waves(vec2 at, float distance_m, Footprint pixel) {
    Slopes sum = Slopes(vec2(0.0), vec3(0.0), 0.0);
    float compression = 0.0;
    for (int cascade = 0; cascade < CASCADES; ++cascade) {
#if VERTEX_CASCADES > 0
        Slopes seen;  // WebGL does not support ?: on structures
        if (cascade < VERTEX_CASCADES)
            seen = slopes_of_vertices();
        else
            seen = cascade_slopes(cascade, at, distance_m, pixel);
#else
        Slopes seen = cascade_slopes(cascade, at, distance_m, pixel);
#endif
#ifdef SHORE
        seen = held_back(seen, shore.weights[cascade]);
#endif
        sum = Slopes(sum.h + seen.h, sum.d + seen.d, sum.variance + seen.variance);
        if (cascade < FOAM_CASCADES)
            compression -= foam_cascade[cascade].z * (seen.d.x + seen.d.y + dot(foam_front.xy, seen.h));
    }
    vec2 slopes_of_all = normal_slopes(sum);
#ifdef SHORE
    slopes_of_all -= shore.water.yz;
#endif
    return Waves(slopes_of_all, sum.variance, 0.0, 0.0, compression);
}

// Returns the width of a sample of ripples, metres. Samples lie along the longer side of the
// footprint, and together they cover it. Ripples of two pixels would show as noise, and the glints
// on them as single pixels, so samples are wider than a pixel.
float ripple_sample_m(Footprint pixel) {
    float x2 = dot(pixel.dx, pixel.dx), y2 = dot(pixel.dy, pixel.dy);
    return 1.45 * max(sqrt(min(x2, y2)), 0.5 * sqrt(max(x2, y2))) + 1e-6;
}

// Returns a layer of ripples: slopes in xy, and in w the fraction of their mean square that the
// pixel resolves. The period is decimetres, so thousands of periods are visible. They are blended
// from copies, like a single cascade.
vec4 layer_of_ripples(int layer, vec2 at, Footprint pixel) {
    vec2 row = detail_turn[layer].xy;
    mat2 turn = mat2(row.x, -row.y, row.y, row.x);
    vec2 uv = turn * at + (layer == 0 ? detail_shift.xy : detail_shift.zw);
    float mip = log2(ripple_sample_m(pixel) * length(row) * 256.0);
#if SHADING == HIGH
    vec2 noise_uv = turn * at / ripple_noise_tiles + (layer == 0 ? detail_noise.xy : detail_noise.zw);
    Copies copies = copies_along(16.0 * (textureLod(detail, noise_uv, 5.0).z - 0.5));
    vec2 off = turn * (dot(pixel.dx, pixel.dx) > dot(pixel.dy, pixel.dy) ? pixel.dx : pixel.dy);
    off *= 0.25 / max(length(off), 1.0);
    vec4 a = textureLod(detail, uv + copies.first - off, mip);
    vec4 b = textureLod(detail, uv + copies.first + off, mip);
    vec4 c = textureLod(detail, uv + copies.second - off, mip);
    vec4 d = textureLod(detail, uv + copies.second + off, mip);
    vec2 first = a.xy + b.xy - 1.0, second = c.xy + d.xy - 1.0;
    vec2 apart = vec2(dot(a.xy - b.xy, a.xy - b.xy), dot(c.xy - d.xy, c.xy - d.xy));
    // Slopes are stored with a standard deviation of 1/4, so their mean square is 1/16.
    vec4 sum = vec4(copies.weights.x * first + copies.weights.y * second, 0.0,
                    0.25 * (a.w + b.w + c.w + d.w) - 16.0 * dot(copies.weights * copies.weights, apart));
#else
    vec4 texel = textureLod(detail, uv, mip);
    vec4 sum = vec4(texel.xy * 2.0 - 1.0, texel.zw);
#endif
    // The longest ripples are a third of the period. At the mip of 2 texels no ripple is resolved.
    return sum * clamp(7.0 - mip, 0.0, 1.0);
}

// Rotates the slopes of a layer to world axes.
vec2 rotated_back(int layer, vec2 slopes) {
    vec2 row = detail_turn[layer].zw;  // cosine and sine
    return vec2(row.x * slopes.x - row.y * slopes.y, row.y * slopes.x + row.x * slopes.y);
}

// Returns the gust factor of the roughness. Gusts are patches of rougher water, hundreds of metres
// wide.
float gust_at(vec2 at) {
#if SHADING == HEADSET
    return 1.0;
#else
    // The finer noise repeats visibly, so the wider noise distorts it.
    float wide = texture(detail, at.yx * noise_scale.w + gust_shift.zw).z;
    float fine = texture(detail, at * noise_scale.z + gust_shift.xy + vec2(0.9, -0.7) * wide).z;
    return clamp(0.35 + 1.3 * (fine + wide - 0.5), 0.35, 1.7);
#endif
}

// Adds the unresolved (subgrid) roughness waves.y^2. Ripples show a fraction of it as slopes where
// pixels are small enough.
void add_water_between_texels(vec2 at, Footprint pixel, inout Waves seen) {
    float gust = gust_at(at);
    vec4 a = layer_of_ripples(0, at, pixel);
#if SHADING == HEADSET
    vec2 slopes = rotated_back(0, a.xy) * sqrt(2.0);
    float shown = a.w;
#else
    vec4 b = layer_of_ripples(1, at, pixel);
    vec2 slopes = rotated_back(0, a.xy) + rotated_back(1, b.xy);
    float shown = 0.5 * (a.w + b.w);
#endif
    float mean_square = water_backscattering.w;
    seen.slopes += sqrt(gust * mean_square * 0.5) * 4.0 * slopes;
    float rest = max(waves.y * waves.y - mean_square, 0.0);
    seen.ripples = gust * mean_square * (1.0 - shown);
    seen.alpha2 = clamp(seen.alpha2 + rest + seen.ripples, 0.0004, 1.0);
}

#if SURFACE == OPEN
Waves waves_at(vec2 at, float distance_m) {
    Footprint pixel = footprint_of(at);
    Waves seen = resolved_waves(at, distance_m, pixel);
    add_water_between_texels(at, pixel, seen);
    return seen;
}
#endif
