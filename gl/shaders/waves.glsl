// The surface in a pixel: normal and roughness from the mips of the tiles' slopes, ripples that no texel holds, and where the
// water folds.
//
// VR Ocean, equations 47 and 48 (the normal); Olano and Baker 2010, "LEAN Mapping".
uniform highp sampler2DArray slopes;   // of a tile: h_x, h_z, D_xx, D_zz, as sim/slope_sum.hpp says
uniform highp sampler2DArray moments;  // D_xz, variance of h_x, of h_z, covariance
uniform sampler2D detail;              // slopes of ripples, noise for gusts and foam, how much of the slopes this mip still holds

// A pixel near the horizon covers a long and thin piece of sea, which mips, being square, would blur to nothing. Taps
// along it, each from a mip as wide as the piece is; the same on every driver, unlike their anisotropic filters.
const int most_taps = 4;
struct Footprint {
    vec2 along;    // from one end to the other, metres at rest
    float long_m;  // the length of that
    float wide_m;  // of a tap
};

Footprint footprint_of(vec2 at) {
    vec2 dx = dFdx(at), dy = dFdy(at);
    float x2 = dot(dx, dx), y2 = dot(dy, dy);
    float long_side = max(sqrt(max(x2, y2)), 1e-6);
    return Footprint(x2 > y2 ? dx : dy, long_side, max(sqrt(min(x2, y2)), long_side / float(most_taps)));
}

// As many taps as lie further apart than texels do: near the eye, where texels are larger than pixels, it is one.
int taps_of(Footprint pixel, float texel_m) {
    return clamp(int(ceil(pixel.long_m / max(pixel.wide_m, texel_m))), 1, most_taps);
}

// The place of a tap, in parts of the whole length from the middle.
float tap(int i, int taps) { return (float(i) + 0.5) / float(taps) - 0.5; }

// How the surface changes along the world's x and z at rest, and the mean square of the slopes that the pixel averages away.
struct Slopes {
    vec2 h;          // of the height
    vec3 d;          // of the sideways displacement: D_xx, D_zz, D_xz
    float variance;  // of h, both axes
};

// Bytes of which 128 is zero.
const float signed_scale = 255.0 / 127.0, signed_zero = 128.0 / 127.0;

// What a tile's maps say around a place in them. `along` is the pixel's length in texture coordinates, `mip` as wide as a tap.
// Where slopes differ between taps, their variance counts as averaged away.
Slopes look_at_tile(int tile, vec2 uv, vec2 along, float mip, int taps) {
    vec4 sum = vec4(0.0);
    float square = 0.0;
    for (int i = 0; i < taps; ++i) {
        vec4 texel = textureLod(slopes, vec3(uv + along * tap(i, taps), tile), mip) * signed_scale - signed_zero;
        sum += texel;
        square += dot(texel.xy, texel.xy);
    }
    sum /= float(taps);
    float scatter = max(square / float(taps) - dot(sum.xy, sum.xy), 0.0);
    vec4 moment = textureLod(moments, vec3(uv, tile), mip);
    float range = tile_slope[tile].x;
    return Slopes(sum.xy * range, vec3(sum.zw, moment.x * signed_scale - signed_zero) * range,
                  scatter * range * range + (moment.y + moment.z) * tile_slope[tile].y);
}

// The same of a pixel. A tile of which no wave is left in the pixel is roughness, and costs nothing.
Slopes tile_slopes(int tile, vec2 at, Footprint pixel) {
    float side = tile_scale[tile].z;
    float mip = log2(pixel.wide_m * tile_scale[tile].x);
    float weight = weight_of_tile(tile, mip);
    float all = tile_slope[tile].z;
    if (weight <= 0.0) return Slopes(vec2(0.0), vec3(0.0), all);
    // Beyond a whole tile there is nothing to tell apart.
    vec2 along = way_in_tile(tile, pixel.along) * min(1.0, side / pixel.long_m);
    Slopes seen = look_at_tile(tile, place_in_tile(tile, at), along, mip, taps_of(pixel, 1.0 / tile_scale[tile].x));
    return Slopes(weight * seen.h, weight * seen.d, mix(all, seen.variance, weight * weight));
}

// VR Ocean, equation 48, as `y` of the normal.
float jacobian_of(vec3 d) { return (1.0 + d.x) * (1.0 + d.y) - d.z * d.z; }

// The normal of the sum of all tiles, as its slopes in the world: x and z over y, at most 4.9.
vec2 normal_slopes(Slopes sum) {
    vec3 normal = vec3(sum.h.y * sum.d.z - sum.h.x * (1.0 + sum.d.y), jacobian_of(sum.d),
                       sum.h.x * sum.d.z - sum.h.y * (1.0 + sum.d.x));
    return normal.xz / max(normal.y, 0.2 * length(normal));
}

// 0 where no foam begins, 1 where the water folds further than most. `shown` is the part of the waves' height that the pixel
// shows: where none is left there is no foam.
float folding(float begins, float jacobian, float shown) {
    return smoothstep(begins + 0.08 * shown, begins - mix(0.07, 0.14, shown), jacobian);
}

struct Waves {
    vec2 slopes;   // with the sign of the normal
    float alpha2;  // GGX roughness squared: slopes below the size of a pixel, mean square
    float foam;    // 0 where the water does not fold, 1 where it does further than most
};

// Foam is where the sum of the tiles folds. Each tile's own Jacobian is as far below 1 where foam begins as that tile's waves
// go in that part of the sea; independent waves go as far together as the root of the sum of the squares, each tile with the
// part of its variance that the pixel shows (SeaFigures::whitecap_depth_of_sum). So far away, where only long waves are left, as much of the sea is white.
Waves resolved_waves(vec2 at, Footprint pixel) {
    Slopes sum = Slopes(vec2(0.0), vec3(0.0), 0.0);
    vec3 folds = vec3(0.0);
    float depth = 0.0, whole_depth = 1e-6;
    for (int tile = 0; tile < TILES; ++tile) {
        Slopes seen = tile_slopes(tile, at, pixel);
        sum = Slopes(sum.h + seen.h, sum.d + seen.d, sum.variance + seen.variance);
        float begins = 1.0 - tile_slope[tile].w;
        if (begins > 5.0) continue;  // its waves break without white water
        folds += seen.d;
        whole_depth += begins * begins;
        depth += begins * begins * clamp(1.0 - seen.variance / tile_slope[tile].z, 0.0, 1.0);
    }
    float foam = folding(1.0 - foam_trail.y * sqrt(depth), jacobian_of(folds), sqrt(depth / whole_depth));
    return Waves(normal_slopes(sum), sum.variance, foam);
}

#if TILES == 1
// From above, or far away, a sea that repeats every L shows as a carpet. The waves of a second copy, turned by 20.9
// degrees and stretched by the golden ratio, which meet the first in no period, take over part of the slopes there.
// Their weights are those of independent waves: the mean square slope stays what it is.
void mix_second_copy(vec2 at, Footprint pixel, float distance_m, inout Waves mixed) {
    float second = 0.66 * smoothstep(0.4, 4.0, distance_m / tile_scale[0].z);
    if (second <= 0.0) return;
    const mat2 turn = mat2(0.9342, 0.3567, -0.3567, 0.9342);
    float scale = 0.618034 / tile_scale[0].z;
    float texels_a_m = 0.618034 * tile_scale[0].x;
    vec2 along = turn * pixel.along * (scale * min(1.0, 1.0 / (scale * pixel.long_m)));
    Slopes seen = look_at_tile(0, turn * at * scale + second_shift.xy, along, log2(pixel.wide_m * texels_a_m),
                               taps_of(pixel, 1.0 / texels_a_m));
    mixed.slopes = sqrt(1.0 - second * second) * mixed.slopes + second * (normal_slopes(seen) * turn);
    mixed.alpha2 = mix(mixed.alpha2, seen.variance, second * second);
}
#endif

// A layer of ripples: slopes in xy, in w how much of their mean square the pixel does not average away.
vec4 layer_of_ripples(int layer, vec2 uv, Footprint pixel) {
    vec2 row = detail_turn[layer].xy;
    float tiles_a_m = length(row);
    float mip = log2(pixel.wide_m * tiles_a_m * 256.0);
    // Their longest waves are a third of the texture: at 2 texels none is left.
    if (mip >= 7.0) return vec4(0.0);
    vec2 along = vec2(row.x * pixel.along.x + row.y * pixel.along.y, row.x * pixel.along.y - row.y * pixel.along.x) *
                 min(1.0, 1.0 / (tiles_a_m * pixel.long_m));
    int taps = taps_of(pixel, 1.0 / (256.0 * tiles_a_m));
    vec4 sum = vec4(0.0);
    float square = 0.0;
    for (int i = 0; i < taps; ++i) {
        vec4 texel = textureLod(detail, uv + along * tap(i, taps), mip);
        vec2 slope = texel.xy * 2.0 - 1.0;
        sum += vec4(slope, texel.zw);
        square += dot(slope, slope);
    }
    sum /= float(taps);
    // Slopes are stored as a quarter of their deviations: their mean square is 1/16.
    sum.w -= 16.0 * max(square / float(taps) - dot(sum.xy, sum.xy), 0.0);
    return sum * min(7.0 - mip, 1.0);
}

vec2 detail_uv(int layer, vec2 at) {
    vec2 row = detail_turn[layer].xy;
    vec2 shift = layer == 0 ? detail_shift.xy : detail_shift.zw;
    return vec2(row.x * at.x + row.y * at.y, row.x * at.y - row.y * at.x) + shift;
}

// The slopes of a layer, turned back into the world.
vec2 turned_back(int layer, vec2 slopes) {
    vec2 row = detail_turn[layer].zw;  // cosine and sine
    return vec2(row.x * slopes.x - row.y * slopes.y, row.y * slopes.x + row.x * slopes.y);
}

// Gusts: patches of rougher water, hundreds of metres wide, that every sea has.
float gust_at(vec2 at) {
    float gust = texture(detail, at * noise_scale.z + gust_shift.xy).z +
                 texture(detail, at.yx * noise_scale.w + gust_shift.zw).z;
    return clamp(0.35 + 1.3 * (gust - 0.5), 0.35, 1.7);
}

// The water that no tile holds: waves.y squared, of which ripples show their part as slopes where pixels are small enough.
void add_water_between_texels(vec2 at, Footprint pixel, inout Waves seen) {
    float gust = gust_at(at);
    vec4 a = layer_of_ripples(0, detail_uv(0, at), pixel);
    vec4 b = layer_of_ripples(1, detail_uv(1, at), pixel);
    float mean_square = water_backscattering.w;
    float amplitude = sqrt(gust * mean_square * 0.5) * 4.0;
    seen.slopes += amplitude * (turned_back(0, a.xy) + turned_back(1, b.xy));
    float rest = max(waves.y * waves.y - mean_square, 0.0);
    seen.alpha2 = clamp(seen.alpha2 + rest + gust * mean_square * (1.0 - 0.5 * (a.w + b.w)), 0.0004, 1.0);
}

Waves waves_at(vec2 at, float distance_m) {
    Footprint pixel = footprint_of(at);
    Waves seen = resolved_waves(at, pixel);
#if TILES == 1
    mix_second_copy(at, pixel, distance_m, seen);
#endif
    add_water_between_texels(at, pixel, seen);
    return seen;
}
