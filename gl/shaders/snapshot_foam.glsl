// Foam of the cascades, from snapshots of their compression (sim/snapshot_foam.hpp). Snapshots are
// sampled at undisplaced positions, so foam moves with the water. HEADSET samples every second
// snapshot. The compression of the present is that of the slopes that the pixel shows.
uniform mediump sampler2DArray snapshots;  // layer i FOAM_CASCADES + j: image i of cascade j

#if SHADING == HEADSET
const int snapshot_images = 2;
#else
const int snapshot_images = 4;
#endif
const float foam_ramp = 0.3, no_foam_level = 1000.0;
// Lace gives the structure of shorter lengths.
const float narrowest_foam_m = 0.2;

struct FoamOfWaves {
    float cover;  // covered fraction
    float mean;   // 0: value at a point; 1: mean over whitecaps of any age and the water between
    float thick;  // thickness of breaking foam: 1 for plunging waves, less for small ones, 2 for surf
};

const FoamOfWaves no_foam = FoamOfWaves(0.0, 0.0, 1.0);

// Combines foam with foam of another source. At a point the larger value counts. Means over many
// whitecaps are independent, so if they cover the fractions a and b, 1 - (1 - a)(1 - b) is covered.
// Whitecaps are a few texels wide, so the fourth mip hardly resolves any.
FoamOfWaves with_foam_of(FoamOfWaves all, float cover, float mip, float thick) {
    float mean = smoothstep(1.0, 4.0, mip);
    float both = all.cover * cover, sum = max(all.cover + cover, 1e-4);
    return FoamOfWaves(mix(max(all.cover, cover), all.cover + cover - both, mean), (all.cover * all.mean + cover * mean) / sum,
                       mix(all.thick, thick, mix(smoothstep(0.5, 0.9, cover / sum), cover / sum, mean)));
}

float shore_weight_of_cascade(int cascade) {
#ifdef SHORE
    return shore.weights[cascade];
#else
    return 1.0;
#endif
}

vec4 compressions_of(int image, int cascade, vec2 uv, float mip) {
    return 8.0 * textureLod(snapshots, vec3(uv, image * FOAM_CASCADES + cascade), mip) - 3.0;
}

// Adds the weighted compressions of a cascade's snapshots. Without a loop, because optimisers
// unroll only the innermost one.
void add_compressions(int cascade, vec2 uv, float mip, float weight, inout vec4 sums[snapshot_images]) {
    sums[0] += weight * compressions_of(0, cascade, uv, mip);
    sums[1] += weight * compressions_of(1, cascade, uv, mip);
#if SHADING != HEADSET
    sums[2] += weight * compressions_of(2, cascade, uv, mip);
    sums[3] += weight * compressions_of(3, cascade, uv, mip);
#endif
}

// Returns the foam of water whose compression is that of the snapshots, and `present` now, in
// standard deviations. Normal noise `torn` is added to all of them; `spread` is the deviation of the
// sum, by which the threshold grows.
FoamOfWaves foam_of_snapshots(vec2 at, float distance_m, float present, float wide_m, float torn, float spread) {
    if (foam_kind.x >= no_foam_level) return no_foam;
    vec4 sums[snapshot_images];
    for (int image = 0; image < snapshot_images; ++image) sums[image] = vec4(0.0);
    float wide = max(wide_m, narrowest_foam_m);
    for (int cascade = 0; cascade < FOAM_CASCADES; ++cascade) {
        float mip = log2(wide * cascade_scale[cascade].x);
        float weight = foam_cascade[cascade].w * weight_of_cascade(cascade, mip) * shore_weight_of_cascade(cascade);
        vec2 uv = place_of_pixel(cascade, at, distance_m) - foam_cascade[cascade].xy;
#if SHADING == HIGH && CASCADES == 1
        Copies copies = copies_at(0, at, distance_m);
        if (!copies.are_one) {
            add_compressions(0, uv + copies.second, mip, weight * copies.weights.y, sums);
            weight *= copies.weights.x;
            uv += copies.first;
        }
#endif
        if (weight > 0.0) add_compressions(cascade, uv, mip, weight, sums);
    }

    float scale = 1.0 / (foam_ramp * spread), offset = 0.5 + torn * scale - foam_kind.x / foam_ramp;
    float foam = clamp(offset + present * scale, 0.0, 1.0);
    for (int image = 0; image < snapshot_images; ++image) {
        vec4 left = clamp(offset + sums[image] * scale, 0.0, 1.0) - foam_age[image];
        foam = max(foam, max(max(left.x, left.y), max(left.z, left.w)));
    }
    // What a wide pixel does not resolve breaks too.
    float octave = clamp(log2(4.0 * wide), 0.0, 10.999);
    vec4 left_out = mix(foam_filter[int(octave)], foam_filter[int(octave) + 1], fract(octave));
    float mean = smoothstep(0.15, 0.45, left_out.x);
    if (mean > 0.0) {
        float count = 0.0, all = 1e-3;
        for (int image = 0; image < snapshot_images; ++image) {
            vec4 counts = max(1.0 - foam_age[image], 0.0);
            vec4 x = clamp((foam_kind.x - sums[image]) / max(left_out.x, 0.1), 0.0, 8.0);
            count += dot(counts, exp(left_out.y + x * (left_out.z + left_out.w * x)));
            all += dot(counts, vec4(1.0));
        }
        float mean_foam = mean * (1.0 - exp(-count / all));
        mean *= min(mean_foam / max(foam, 1e-4), 1.0);
        foam = max(foam, mean_foam);
    }
    return FoamOfWaves(foam, mean, 1.0);
}

#ifdef SHORE
// Adds foam of waves that break on the shore. It is thick and hides foam of the cascades. Its
// texels are metres wide, so `ragged` distorts their edges, which would otherwise show as squares.
FoamOfWaves with_foam_of_shore(FoamOfWaves all, vec2 ragged) {
#if SHADING == HEADSET
    float foam = shore.water.w;
#else
    float foam = shore_water_at(shore.at + ragged * (1.5 / shore_size.z), shore.mip).w;
#endif
    float most = max(all.cover, foam);
    float ours = smoothstep(0.3, 0.7, foam / max(all.cover + foam, 1e-4));
    return FoamOfWaves(most, mix(all.mean, smoothstep(1.0, 4.0, shore.mip), ours), mix(all.thick, 2.0, ours));
}
#endif
