// Water too small for the sea's cascades, made where it is shaded: a lake (bumps of noise), a coast (ridges of noise), a river (bumps
// that a map of its flow carries along), a pond (waves of the exponential of a sine). Slopes are true derivatives of
// the heights, and waves finer than a pixel count as its roughness, so that nothing sparkles and nothing is lost.
//
// Perlin 2002, "Improving Noise"; Perlin and Neyret 2001, "Flow Noise"; Jarzynski and Olano 2020, "Hash Functions for GPU
// Rendering" (PCG).

const int octaves = 8;
const int pond_waves = 24;

struct Bumps {
    float height;
    vec2 gradient;  // of the height, along x and z
    float left;     // mean square of the slopes that are finer than the pixel
    float crest;    // 1 on the sharpest ridges, where a coast is white
};

// How much of waves half of whose length is so long is left in pixels, or between vertices, so far apart.
float shown_in(float half_wave_m, float apart_m) { return 1.0 - smoothstep(0.4, 1.0, apart_m / half_wave_m); }

uint mixed_bits(uint bits) {
    uint state = bits * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// A corner's gradient turns as time goes on: waves rise and fall where they are. The grid repeats after 64 cells.
vec2 turning_gradient(ivec2 corner, int octave, float turn) {
    uvec2 wrapped = uvec2(corner & 63);
    float angle = 6.2831853 * (float(mixed_bits(wrapped.x + 64u * wrapped.y + 4096u * uint(octave)) >> 8u) / 16777216.0 + turn);
    return vec2(cos(angle), sin(angle));
}

// Gradient noise, within [-0.71, 0.71], and its derivatives. E n^2 = 0.0466, E |n| = 0.1764.
vec3 turning_noise(vec2 place, ivec2 cell, int octave, float turn) {
    vec2 whole = floor(place), f = place - whole;
    ivec2 corner = cell + ivec2(whole);
    vec2 a = turning_gradient(corner, octave, turn), b = turning_gradient(corner + ivec2(1, 0), octave, turn);
    vec2 c = turning_gradient(corner + ivec2(0, 1), octave, turn), d = turning_gradient(corner + ivec2(1, 1), octave, turn);
    vec4 at = vec4(dot(a, f), dot(b, f - vec2(1.0, 0.0)), dot(c, f - vec2(0.0, 1.0)), dot(d, f - 1.0));
    vec2 w = f * f * f * (f * (f * 6.0 - 15.0) + 10.0), slope = 30.0 * f * f * (f * (f - 2.0) + 1.0);
    vec2 rows = mix(at.xz, at.yw, w.x);
    vec2 gradient = mix(mix(a, b, w.x), mix(c, d, w.x), w.y);
    gradient.x += slope.x * mix(at.y - at.x, at.w - at.z, w.y);
    gradient.y += slope.y * (rows.y - rows.x);
    return vec3(mix(rows.x, rows.y, w.y), gradient);
}
#if SURFACE == COAST
const float noise_slope_square = 0.6506;  // E |grad sqrt(n^2 + 0.03^2)|^2
const float half_wave_cells = 0.4;        // a ridge is twice as fine as the noise that it is made of
#else
const float noise_slope_square = 0.7796;  // E |grad n|^2
const float half_wave_cells = 0.75;
#endif

// A sum of octaves. Those of a coast are ridges, each moved by the height of those before it: small ridges gather on large ones. `rough`
// scales all of them.
Bumps sum_of_octaves(vec2 at, float apart_m, float rough) {
    Bumps sum = Bumps(0.0, vec2(0.0), 0.0, 1.0);
    for (int i = 0; i < octaves; ++i) {
        vec4 grid = bump_grid[i];  // xy: cosine and sine of its turn; z: cells a metre; w: height
        vec4 place = bump_place[i];
        float height = grid.w * rough, contraction = bump_kind.x;
        float steepness = height * grid.z;
        float shown = shown_in(half_wave_cells / grid.z, apart_m);
        sum.left += (1.0 - shown * shown) * steepness * steepness * noise_slope_square * 0.5 * (1.0 + contraction * contraction);
        if (shown <= 0.0) continue;
        vec2 warp = bump_kind.zw;
        vec2 moved = at + warp * sum.height;
        vec2 row = grid.xy * grid.z;
        vec2 p = vec2(row.x * moved.x + row.y * moved.y, contraction * (row.x * moved.y - row.y * moved.x));
        vec3 n = turning_noise(p + place.xy, ivec2(place.zw), i, bump_turn[i / 4][i % 4]);
#if SURFACE == COAST
        float ridge = sqrt(n.x * n.x + 0.0009);
        sum.crest *= i < 2 ? 1.0 - smoothstep(0.03, i == 0 ? 0.10 : 0.22, ridge) * shown : 1.0;
        n = vec3(0.18 - ridge, -n.x / ridge * n.yz);
#endif
        vec2 g = vec2(row.x * n.y - contraction * row.y * n.z, row.y * n.y + contraction * row.x * n.z) * (height * shown);
        sum.gradient += g + sum.gradient * dot(warp, g);
        sum.height += height * shown * n.x;
    }
    return sum;
}

// Waves of exp(sin - 1): sharp crests, broad troughs. Each moves those after it along its own way by its slope, so that small waves
// gather on the crests of large ones; `turned` is the derivative of the place that has been moved so far.
Bumps sum_of_pond_waves(vec2 at, float apart_m) {
    Bumps sum = Bumps(0.0, vec2(0.0), 0.0, 0.0);
    mat2 turned = mat2(1.0);
    for (int i = 0; i < pond_waves; ++i) {
        vec4 each = pond_wave[i];  // xy: wave vector, rad/m; z: height; w: phase
        float k = length(each.xy);
        float shown = shown_in(3.1415927 / k, apart_m);
        // E (exp(sin p - 1) cos p)^2 = I1(2) / (2 e^2)
        sum.left += (1.0 - shown * shown) * each.z * each.z * k * k * 0.1076;
        if (shown <= 0.0) continue;
        float phase = dot(each.xy, at) + each.w;
        vec2 faster = each.xy * turned;
        float s = sin(phase), c = cos(phase), wave = exp(s - 1.0);
        sum.height += each.z * shown * (wave - 0.4658);  // E exp(sin p - 1) = I0(1) / e
        sum.gradient += each.z * shown * wave * c * faster;
        float drag = bump_kind.y * each.z;
        vec2 way = each.xy / k;
        at -= way * (drag * wave * c);
        turned -= outerProduct(way, faster * (drag * wave * (c * c - s)));
    }
    return sum;
}

// What stands above the level of rest: a vertex moves up and down there. A lake's and a river's waves are centimetres, and
// their surface stays flat.
float small_height(vec2 at, float spacing_m) {
#if SURFACE == POND
    return sum_of_pond_waves(at, spacing_m).height;
#elif SURFACE == COAST
    return sum_of_octaves(at, spacing_m, 1.0).height;
#else
    return 0.0;
#endif
}
