// Open sea. In the order of main():
//
//   waves       normal and roughness from the mips of the tiles' slopes, ripples that no texel holds, coverage by foam
//   reflection  the sky, mirrored by waves of which those that lean towards the eye count most, Fresnel
//   sun         its glint, GGX
//   water       light from below: absorption and backscattering (Beer-Lambert), light through crests
//   foam        white and diffuse, over all of it
//   haze        towards the colour that the sky has at the horizon there
//
// Sources: Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering"; Walter et al. 2007 (GGX); Heitz 2014,
// "Understanding the Masking-Shadowing Function"; Bruneton, Neyret and Holzschuch 2010, "Real-time Realistic Ocean
// Lighting using Seamless Transitions from Geometry to BRDF"; Morel and Prieur 1977 (colour of sea water);
// Koepke 1984 (whitecaps); VR Ocean, equations 47 and 48 (the normal); Olano and Baker 2010, "LEAN Mapping".
#ifdef MULTIVIEW
#extension GL_OVR_multiview2 : require
#endif
precision highp float;
precision highp int;
#include "scene.glsl"
#include "tone.glsl"

uniform highp sampler2DArray slopes;   // of a tile: h_x, h_z, D_xx, D_zz, as sim/slope_sum.hpp says
uniform highp sampler2DArray moments;  // D_xz, variance of h_x, of h_z, covariance
uniform sampler2D detail;              // slopes of ripples, foam's structure, how much of the slopes this mip still holds
uniform highp samplerCube sky;         // level m: mirrored by alpha = (m / last)^2

in vec4 place;
#ifndef SKIRT
in vec2 rest;
#endif
out vec4 colour;

const float pi = 3.14159265;
const float water_f0 = 0.02;  // ((1.333 - 1) / (1.333 + 1))^2

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

// 0 where no foam begins, 1 where the water folds further than most.
float folding(float begins, float jacobian) { return smoothstep(begins + 0.08, begins - 0.14, jacobian); }

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
    float depth = 0.0;
    for (int tile = 0; tile < TILES; ++tile) {
        Slopes seen = tile_slopes(tile, at, pixel);
        sum = Slopes(sum.h + seen.h, sum.d + seen.d, sum.variance + seen.variance);
        float begins = 1.0 - tile_slope[tile].w;
        if (begins > 5.0) continue;  // its waves break without white water
        folds += seen.d;
        depth += begins * begins * clamp(1.0 - seen.variance / tile_slope[tile].z, 0.0, 1.0);
    }
    return Waves(normal_slopes(sum), sum.variance, folding(1.0 - foam_trail.y * sqrt(depth), jacobian_of(folds)));
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
    float mean_square = water_scattering.w;
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

// The mean normal of the waves that an eye sees. Of slopes with deviation s around the mean, those that lean towards
// the eye show more of themselves, in proportion to their projected area, max(mu + s_v tan, 0); the mean slope towards
// the eye under this weight is s^2 t P(a) / (mu P(a) + s t p(a)), a = mu / (s t), with Gauss' density p and
// distribution P. At grazing angles this is 1.25 s: the far sea mirrors the sky well above the horizon.
vec3 visible_normal(vec3 normal, vec3 to_eye, float alpha2) {
    float mu = dot(normal, to_eye);
    vec3 along = to_eye - normal * mu;
    float t = max(length(along), 1e-4);
    float s = sqrt(0.5 * alpha2);
    float a = clamp(mu / (s * t), -3.0, 12.0);
    float density = 0.3989423 * exp(-0.5 * a * a);
    float distribution = 1.0 / (1.0 + exp(-1.5976 * a - 0.070566 * a * a * a));  // Page 1977, within 1.4e-4
    float slope = s * distribution / max(a * distribution + density, 1e-4);
    return normalize(normal + along / t * min(slope, 1.5));
}

// Schlick's curve, averaged over slopes of deviation s: Bruneton et al. 2010, equation 16.
float mean_fresnel(float cosine, float s) {
    float grazing = pow(1.0 - cosine, 5.0 * exp(-2.69 * s)) / (1.0 + 22.7 * pow(s, 1.5));
    return water_f0 + (1.0 - water_f0) * grazing;
}

// GGX with Smith's height-correlated masking (Heitz 2014), times the cosine of the light.
float glint(vec3 normal, vec3 to_eye, float alpha2) {
    float nl = dot(normal, sun.xyz);
    if (nl <= 0.0) return 0.0;
    float nv = max(dot(normal, to_eye), 0.01);
    vec3 middle = normalize(sun.xyz + to_eye);
    float nh = max(dot(normal, middle), 0.0);
    alpha2 += 4.0 * sun.w * sun.w;  // the disc is not a point
    float d = nh * nh * (alpha2 - 1.0) + 1.0;
    float distribution = alpha2 / (pi * d * d);
    float visibility =
        0.5 / (nl * sqrt(nv * nv * (1.0 - alpha2) + alpha2) + nv * sqrt(nl * nl * (1.0 - alpha2) + alpha2));
    float fresnel = water_f0 + (1.0 - water_f0) * pow(1.0 - max(dot(middle, to_eye), 0.0), 5.0);
    return distribution * visibility * fresnel * nl;
}

// Light that comes up out of the water. Part of what goes down is scattered back before it is absorbed: 0.33 bb / (a +
// bb) of it in deep water (Morel and Prieur 1977). Over a bottom within sight its sand shines through, dimmed twice.
vec3 upwelling(vec3 light_down, float depth) {
    vec3 absorption = water_absorption.rgb, scattering = water_scattering.rgb;
    vec3 reflectance = 0.33 * scattering / (absorption + scattering);
    vec3 through = exp(-2.0 * (absorption + scattering) * max(depth, 0.0));
    const vec3 sand = vec3(0.35, 0.31, 0.25);
    // 0.54: the surface's transmission and the widening of rays, t / n^2 (Austin 1974).
    return 0.54 * mix(reflectance, sand, through) * light_down / pi;
}

// Sunlight that enters a crest behind and leaves it towards the eye: the water's colour at its most saturated. The way
// through is short near the top of a high wave; scattering is strongly forwards.
vec3 through_crests(vec3 normal, vec3 to_eye, float height) {
    float crest = clamp(height / (0.75 * waves.x), 0.0, 1.0);
    float way = waves.x * mix(1.6, 0.25, crest);
    vec3 taken = exp(-(water_absorption.rgb + water_scattering.rgb) * way);
    float towards = dot(-to_eye, sun.xyz);
    const float g = 0.6;
    float phase = (1.0 - g * g) / (4.0 * pi * pow(1.0 + g * g - 2.0 * g * towards, 1.5));
    // Only faces that look at the eye and away from the sun are lit through.
    float faces = clamp(dot(normal, to_eye), 0.0, 1.0) * clamp(0.75 - 0.75 * dot(normal, sun.xyz), 0.0, 1.0);
    const float scattered_per_m = 0.25;
    float scattered = 1.0 - exp(-scattered_per_m * way);
    return sun_irradiance.rgb * taken * (phase * faces * scattered * crest * crest * 1.6) +
           sky_irradiance.rgb * taken * (0.03 * crest * crest * faces);
}

// Foam stays where the water folded while the crest moves on, so older foam is what the crest has left behind it: the
// Jacobian further down the wind, thinner the older, of the one tile whose waves are those that break. 1 + D_xx + D_zz is the
// Jacobian where all waves run one way.
float foam_behind_crests(vec2 at) {
    int tile = int(foam_trail.x);
    vec2 uv = place_in_tile(tile, at);
    float old = 0.0;
    float weight = 0.62;
    for (int i = 1; i <= 4; ++i) {
        vec2 d = texture(slopes, vec3(uv + foam_trail.zw * float(i), tile), 0.6 * float(i)).zw * signed_scale - signed_zero;
        old = max(old, weight * folding(tile_slope[tile].w, 1.0 + tile_slope[tile].x * (d.x + d.y)));
        weight *= 0.72;
    }
    return old;
}

// How much of the pixel foam covers.
float foam_cover(vec2 at, float fresh, float distance_m) {
    float old = foam_behind_crests(at);
    // Structure: bubbles in cells and threads, at two scales that share no period.
    float lace = 0.62 * texture(detail, at * noise_scale.x + foam_shift.xy).z +
                 0.38 * texture(detail, at.yx * noise_scale.y + foam_shift.zw).z;
    float amount = max(fresh, old);
    float soft = mix(0.22, 0.5, smoothstep(50.0, 800.0, distance_m));
    float cover = smoothstep(1.0 - amount - soft, 1.0 - amount + soft, lace) * smoothstep(0.0, 0.12, amount);
    // Thick where its threads meet, thin between them.
    return cover * mix(0.45 + 0.4 * lace, 0.75 + 0.25 * lace, fresh);
}

#ifdef SKIRT
// The skirt reaches to infinity, and smoothed edges ask for pixels whose middle is beside its triangles, where the
// divisor of interpolation may have changed its sign, and that of `place` with it. The direction remains, up to that
// sign: the ray through the pixel, which leads ahead. It meets the flat sea where it meets it, at the horizon far away.
vec3 place_on_skirt() {
    vec3 ray = place.xyz - eye[EYE].xyz * place.w;
    vec4 middle = viewer_from_clip[EYE] * vec4(0.0, 0.0, 0.0, 1.0);
    if (dot(ray, middle.xyz / middle.w - eye[EYE].xyz) < 0.0) ray = -ray;
    ray = normalize(ray);
    float height = viewer.z + eye[EYE].y;
    return eye[EYE].xyz + ray * (abs(height) / max(height < 0.0 ? ray.y : -ray.y, 1e-6));
}
#endif

void main() {
#ifdef SKIRT
    vec3 at = place_on_skirt();
    vec2 resting = at.xz;
#else
    vec3 at = place.xyz;
    vec2 resting = rest;
#endif
    vec3 from_eye = at - eye[EYE].xyz;
    float distance_m = length(from_eye);
    vec3 to_eye = -from_eye / distance_m;
    float height = at.y + viewer.z;

    Waves surface = waves_at(resting, distance_m);
    vec3 normal = normalize(vec3(surface.slopes.x, 1.0, surface.slopes.y));
    float deviation = sqrt(0.5 * surface.alpha2);

    vec3 mirror = visible_normal(normal, to_eye, surface.alpha2);
    vec3 reflected = reflect(-to_eye, mirror);
    float level = sqrt(sqrt(surface.alpha2)) * sky_irradiance.w;
    vec3 sky_light = textureLod(sky, reflected, level).rgb;
    float fresnel = mean_fresnel(clamp(dot(normal, to_eye), 0.0, 1.0), deviation);

    vec3 sun_light = sun_irradiance.rgb * glint(normal, to_eye, surface.alpha2);

    float sun_height = max(sun.y, 0.0);
    vec3 light_down = sun_irradiance.rgb * sun_height * (1.0 - mean_fresnel(sun_height, 0.15)) + 0.934 * sky_irradiance.rgb;
    vec3 water_light = upwelling(light_down, water_absorption.w + height) + through_crests(normal, to_eye, height);

    vec3 radiance = mix(water_light, sky_light, fresnel) + sun_light;

    // Thick fresh foam reflects 0.6 and more, thin old foam less (Whitlock et al. 1982; Koepke 1984 has 0.55 in the mean).
    float foam = foam_cover(resting, surface.foam, distance_m);
    vec3 foam_light = (sun_irradiance.rgb * max(dot(normalize(normal + vec3(0.0, 0.5, 0.0)), sun.xyz), 0.0) +
                       sky_irradiance.rgb * (0.5 + 0.5 * normal.y)) * (0.7 / pi);
    radiance = mix(radiance, foam_light, foam);

    // Where haze ends the view it has the sky's own colour at the horizon, so the two meet without a line. The second
    // factor softens the last quarter of a degree, in which rows of pixels are kilometres apart.
    vec3 horizon = textureLod(sky, normalize(vec3(from_eye.x, 0.0, from_eye.z)), 0.0).rgb;
    float soft = distance_m / haze.w;
    vec3 left = exp(-haze.rgb * distance_m) * exp(-soft * soft);
    colour = screen_colour(mix(horizon, radiance, left));
}
