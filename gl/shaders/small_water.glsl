// Procedural waves of small water, which the cascades do not model: a lake (noise), a coast (ridged
// noise), a river (noise that a flow map advects), a pond (waves of the exponential of a sine).
//
// Slopes are exact derivatives of the heights. Waves shorter than a pixel contribute to its
// roughness instead, which prevents aliasing and conserves the slope variance.
//
// Perlin 2002, "Improving Noise"; Perlin and Neyret 2001, "Flow Noise"; Jarzynski and Olano 2020,
// "Hash Functions for GPU Rendering" (PCG).

const int octaves = 8;
const int pond_waves = 24;

struct Bumps {
    float height;
    vec2 gradient;  // gradient of the height along x and z
    float unresolved; // mean square of the slopes that the pixel does not resolve
    float crest;    // 1 on the sharpest ridges, where a coast has foam
};

// Returns the amplitude factor of waves with half the wavelength `half_wave_m` for samples
// `apart_m` apart.
float shown_in(float half_wave_m, float apart_m) { return 1.0 - smoothstep(0.4, 1.0, apart_m / half_wave_m); }

uint mixed_bits(uint bits) {
    uint state = bits * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// Returns the gradient at a grid corner. It rotates with time, so waves rise and fall in place. The
// grid has a period of 64 cells.
vec2 turning_gradient(ivec2 corner, int octave, float turn) {
    uvec2 wrapped = uvec2(corner & 63);
    float angle = 6.2831853 * (float(mixed_bits(wrapped.x + 64u * wrapped.y + 4096u * uint(octave)) >> 8u) / 16777216.0 + turn);
    return vec2(cos(angle), sin(angle));
}

// Returns gradient noise in [-0.71, 0.71] and its derivatives. E n^2 = 0.0466, E |n| = 0.1764.
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
const float half_wave_cells = 0.4;        // ridges have half the wavelength of their noise
#else
const float noise_slope_square = 0.7796;  // E |grad n|^2
const float half_wave_cells = 0.75;
#endif

// Returns a sum of octaves, scaled by `rough`. Octaves of a coast are ridges. Each is displaced by
// the height of the previous ones, so that small ridges concentrate on large ones.
Bumps sum_of_octaves(vec2 at, float apart_m, float rough) {
    Bumps sum = Bumps(0.0, vec2(0.0), 0.0, 1.0);
    for (int i = 0; i < octaves; ++i) {
        vec4 grid = bump_grid[i];
        vec4 place = bump_place[i];
        float height = grid.w * rough, contraction = bump_kind.x;
        float steepness = height * grid.z;
        float shown = shown_in(half_wave_cells / grid.z, apart_m);
        sum.unresolved += (1.0 - shown * shown) * steepness * steepness * noise_slope_square * 0.5 * (1.0 + contraction * contraction);
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

// Returns a sum of waves exp(sin - 1), which have sharp crests and broad troughs. The slope of each
// wave displaces the following waves along its direction, so that small waves concentrate on the
// crests of large ones. `turned` is the derivative of the displaced position.
Bumps sum_of_pond_waves(vec2 at, float apart_m) {
    Bumps sum = Bumps(0.0, vec2(0.0), 0.0, 0.0);
    mat2 turned = mat2(1.0);
    for (int i = 0; i < pond_waves; ++i) {
        vec4 each = pond_wave[i];  // xy: wave vector, rad/m; z: height; w: phase
        float k = length(each.xy);
        float shown = shown_in(3.1415927 / k, apart_m);
        // E (exp(sin p - 1) cos p)^2 = I1(2) / (2 e^2)
        sum.unresolved += (1.0 - shown * shown) * each.z * each.z * k * k * 0.1076;
        if (shown <= 0.0) continue;
        float phase = dot(each.xy, at) + each.w;
        vec2 faster = each.xy * turned;
        float s = sin(phase), c = cos(phase), wave = exp(s - 1.0);
        sum.height += each.z * shown * (wave - 0.4658);  // E exp(sin p - 1) = I0(1) / e
        sum.gradient += each.z * shown * wave * c * faster;
        float drag = bump_kind.y * each.z;
        vec2 direction = each.xy / k;
        at -= direction * (drag * wave * c);
        turned -= outerProduct(direction, faster * (drag * wave * (c * c - s)));
    }
    return sum;
}

// Returns the height of a vertex above the still-water level. Waves of lakes and rivers are
// centimetres high, so their mesh stays level.
float small_height(vec2 at, float spacing_m) {
#if SURFACE == POND
    return sum_of_pond_waves(at, spacing_m).height;
#elif SURFACE == COAST
    return sum_of_octaves(at, spacing_m, 1.0).height;
#else
    return 0.0;
#endif
}
