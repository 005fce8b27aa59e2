// Cover, structure and light of foam in a pixel.
//
// Snapshots of the cascades give the amount of foam (snapshot_foam.glsl), and a texture gives its
// structure (gl/water/foam_image.hpp). The amount is the mean cover, and an age too: foam of amount
// 1 is breaking now; foam of amount 0.5 broke 1.4 s ago.
//
// Let g be a standard normal variable of the place, a sum of scores of the texture, and z(a) the
// score of the amount a, so that P(g > -z(a)) = a. The sheet has the margin e = g + z(a). It is thick
// where e > thick_margin: young foam is thick in most places, old foam only in the middle of its
// threads. A film covers the water around e = 0, where bubbles add normal noise of film_softness to g,
// and z(a) grows by the deviation of the sum, so the mean cover is a. A pixel resolves a part of g; the
// rest is normal too, so means have a closed form. Cover depends little on the distance.
//
// Whitlock, Bartlett and Gurganus 1982, "Sea foam reflectance and influence on optimum wavelength
// for remote sensing of ocean aerosols"; Koepke 1984, "Effective reflectance of oceanic whitecaps".
// HEADSET samples one scale of lace; MEDIUM samples two, and streaks; HIGH samples three, streaks,
// and bubbles or far streaks.
uniform highp sampler2DArray foam_structure;  // bubbles, lace, streaks

const int bubbles_layer = 0, lace_layer = 1, streaks_layer = 2;
const float foam_texels = 256.0;  // texels along each axis
// Deviations of margins at a point by bubbles, which no texture shows: edges are translucent.
const float film_softness = 0.55, thick_softness = 0.6;
const float thick_margin = 3.0, largest_margin = 3.7;
// Fine structure of weight 0.62 counts for 0.9 in the margin of thick foam: 0.9^2 - 0.62^2 of variance.
const float fine_weight = 0.62, thick_fine_weight = 0.9, thick_variance = 0.43;
// Thick part of the cover, if all ages are equally frequent.
const float thick_in_mean = 0.115;
const float film_share = 0.28;

struct Foam {
    float cover;      // covered fraction of the pixel
    float thickness;  // 0: a film of old bubbles, 1: fresh and opaque
    float plume;      // bubbles below the surface, 0 to 1
    vec2 slopes;      // slopes of the relief
    float hollow;     // 0 on top of the relief, 1 in its hollows
    float grain;      // factor of the light by cells of bubbles; 1 in the mean
    float shade;      // sunlight that a breaking crest keeps away, 0 to 1
};

// Returns the score that a standard normal variable exceeds with probability 1 - fraction (Winitzki
// 2008, "A handy approximation for the error function and its inverse").
float score_of(float fraction) {
    float f = clamp(fraction, 1e-4, 0.9999);
    float log_f = log(4.0 * f * (1.0 - f)), t = 4.3307 + 0.5 * log_f;
    return sign(f - 0.5) * sqrt(max(2.0 * (sqrt(t * t - log_f / 0.147) - t), 0.0));
}

// Returns the probability that a standard normal variable is below x (Page 1977).
float fraction_below(float x) { return 1.0 / (1.0 + exp(-x * (1.5976 + 0.070566 * x * x))); }

// The structure in a pixel.
struct Sheet {
    float score;   // resolved part of g
    float shown;   // its variance
    vec2 slopes;
};

// Adds a scale of structure, whose variance is weight^2. A pixel of length `limit_m` resolves
// nothing of it; each octave has half of the variance of the next wider one.
void add_scale(inout Sheet sheet, vec4 texel, float weight, float pixel_m, float limit_m, float steepness) {
    float seen = clamp(1.0 - pixel_m / limit_m, 0.0, 1.0);
    sheet.score += weight * sqrt(seen) * texel.w;
    sheet.shown += weight * weight * seen;
    sheet.slopes += steepness * seen * texel.yz;
}

// Samples a layer and converts its signed bytes: slopes to [-1, 1], scores to deviations. The mip
// has texels of the pixel's length, but is half a level finer, because interpolation blurs.
vec4 structure(int layer, vec2 uv, float pixel_cascades) {
    vec4 texel = textureLod(foam_structure, vec3(uv, layer), log2(max(pixel_cascades * foam_texels, 1.0)) - 0.5);
    texel.yzw = (texel.yzw * 255.0 - 128.0) / 127.0;
    texel.w *= 3.2;
    return texel;
}

// Lace is sampled at narrower scales too, rotated. Products with complex integers keep the period.
const vec2 wide_lace = vec2(1.0, 0.0), middle_lace = vec2(3.0, 2.0), fine_lace = vec2(11.0, -7.0);

vec4 lace_at(vec2 turn, vec2 at, float pixel_m) {
    vec2 uv = at * noise_scale.y + foam_shift.zw;
    uv = vec2(turn.x * uv.x - turn.y * uv.y, turn.y * uv.x + turn.x * uv.y);
    vec4 texel = structure(lace_layer, uv, pixel_m * noise_scale.y * length(turn));
    texel.yz = vec2(turn.x * texel.y + turn.y * texel.z, turn.x * texel.z - turn.y * texel.y) / length(turn);
    return texel;
}

// Only the open sea has streaks.
#define STREAKS (SHADING >= MEDIUM && SURFACE == OPEN)
#define THREE_SCALES (SHADING == HIGH && SURFACE == OPEN)

#if STREAKS
vec4 streaks_at(int size, vec2 at, float pixel_m) {
    vec2 wind = waves.zw;
    vec4 place = foam_streaks[size];
    vec2 uv = vec2(dot(wind, at), wind.x * at.y - wind.y * at.x) * place.xy + place.zw;
    return structure(streaks_layer, uv, pixel_m * place.y);
}

// Returns the derivatives of a value along x and z, from its differences between pixels.
vec2 gradient_of(float value, Footprint pixel) {
    float area = pixel.dx.x * pixel.dy.y - pixel.dx.y * pixel.dy.x;
    vec2 change = vec2(dFdx(value), dFdy(value)) / (abs(area) < 1e-9 ? 1e-9 : area);
    return vec2(pixel.dy.y * change.x - pixel.dx.y * change.y, pixel.dx.x * change.y - pixel.dy.x * change.x);
}
#endif

// Returns the foam of a pixel.
Foam foam_at(vec2 at, float distance_m, Waves surface, vec3 to_eye) {
    Footprint pixel = footprint_of(at);
    float pixel_m = max(length(pixel.dx), length(pixel.dy));
    const float middle_limit_m = 0.6;
    Sheet sheet = Sheet(0.0, 0.0, vec2(0.0));
    vec4 middle = lace_at(middle_lace, at, pixel_m);
#if STREAKS
    const float wide_limit_m = 2.1;
    vec4 wide = lace_at(wide_lace, at, pixel_m);
#if THREE_SCALES
    add_scale(sheet, middle, 0.5, pixel_m, middle_limit_m, 1.0);
    add_scale(sheet, wide, 0.45, pixel_m, wide_limit_m, 0.6);
#else
    add_scale(sheet, middle, 0.72, pixel_m, middle_limit_m, 1.1);
    add_scale(sheet, wide, 0.55, pixel_m, wide_limit_m, 0.6);
#endif
#else
    add_scale(sheet, middle, 0.97, pixel_m, middle_limit_m, 0.9);
#endif
#if SURFACE == OPEN
    // Edges of breaking crests are ragged at all scales: structure bends the place and the threshold.
#if STREAKS
    vec2 wind = waves.zw, across = vec2(-wind.y, wind.x);
    vec2 bend = wind * (0.22 * wide.w + 0.08 * middle.w) + across * (0.12 * middle.w - 0.12 * wide.w);
    vec2 steepening = gradient_of(surface.compression, pixel);
#else
    vec2 bend = vec2(0.12, 0.09) * middle.w;
#endif
    const float torn = 0.45;
    float spread = sqrt(1.0 + torn * torn * sheet.shown);
    FoamOfWaves there = foam_of_snapshots(at + bend, distance_m, surface.compression, pixel.wide_m,
                                          torn * sheet.score, spread);
#ifdef SHORE
    there = with_foam_of_shore(there, bend);
#endif
#ifdef DYNAMIC_WAVES
    there = with_foam_of(there, surface.crests, log2(max(pixel.wide_m * dynamic_waves_place.w, 1e-3)), 1.0);
#endif
    float amount = there.cover, thickest = min(there.thick, 1.0), mean = there.mean;
    float surf = clamp(there.thick - 1.0, 0.0, 1.0);  // is thick wherever it covers the water
#else
    float amount = surface.crests, thickest = 1.0, mean = 0.0, surf = 1.0;
#endif
    // In a gale windrows gather films of old bubbles, which outlast the foam of the snapshots.
#if STREAKS
    float film = film_share * foam_kind.z;
#else
    float film = 0.0;
#endif
    Foam foam = Foam(0.0, 0.0, amount, vec2(0.0), 0.0, 1.0, 0.0);
#if STREAKS
    // A breaking crest is a lip of foam above the water in front of it.
    // Differences between narrower pixels are those of the texture's bytes.
    float lip_height_m = 0.25 * smoothstep(0.015, 0.04, pixel_m) * (1.0 - smoothstep(0.1, 0.4, pixel_m));
    vec2 rise = steepening / (foam_ramp * spread);
    rise *= min(6.0 / max(length(rise), 1e-3), 1.0);
    float lip = 0.5 + (surface.compression + torn * sheet.score - foam_kind.x * spread) / (foam_ramp * spread);
    float behind = dot(rise, sun.xz) / max(sun.y, 0.25);
    foam.shade = (1.0 - clamp(lip, 0.0, 1.0)) * clamp(lip + lip_height_m * max(behind, 0.5 * length(rise)), 0.0, 1.0);
    foam.slopes = rise * (lip_height_m * clamp(4.0 * lip * (1.0 - lip), 0.0, 1.0));
#endif
    if (amount <= 0.0 && film <= 0.0) return foam;

#if STREAKS
    // Windrows gather old foam too, and begin and end softly, because lace joins them in one sum.
    vec4 streaks = streaks_at(0, at, pixel_m);
    float along = 0.3 * foam_kind.w;
    Sheet rows = Sheet(0.4 * sheet.score, 0.16 * sheet.shown, vec2(0.0));
    add_scale(sheet, streaks, along, pixel_m, 4.0, 0.0);
    add_scale(rows, streaks, 0.8, pixel_m, 4.0, 0.0);
#endif
    float thick_score = 0.0, thick_unseen = thick_variance + thick_softness * thick_softness;
    float hollow_score = -0.5 * middle.w, hollow_shown = clamp(1.0 - pixel_m / middle_limit_m, 0.0, 1.0);
#if THREE_SCALES
    vec4 fine = lace_at(fine_lace, at + 0.02 * middle.yz, pixel_m);
    add_scale(sheet, fine, fine_weight, pixel_m, 0.16, 1.3);
    float fine_shown = clamp(1.0 - pixel_m / 0.16, 0.0, 1.0);
    thick_score = (thick_fine_weight - fine_weight) * sqrt(fine_shown) * fine.w;
    thick_unseen -= thick_variance * fine_shown;
    float grain = 0.8 * fine_shown * fine_shown * fine.w;
    hollow_score -= 0.8 * fine_shown * fine.w;
    // The last sample depends on the pixel size: bubbles near the eye, the widest windrows far away.
    if (pixel_m > 0.35) {
        add_scale(rows, streaks_at(1, at, pixel_m), 0.45 * smoothstep(0.35, 1.5, pixel_m), pixel_m, 25.0, 0.0);
    } else if (pixel_m < 0.006) {
        vec4 bubbles = structure(bubbles_layer, at * noise_scale.x + foam_shift.xy, pixel_m * noise_scale.x);
        add_scale(sheet, bubbles, 0.2, pixel_m, 0.006, 0.8);
        grain += 0.8 * clamp(1.0 - pixel_m / 0.006, 0.0, 1.0) * bubbles.w;
    }
    foam.grain = 1.0 + 0.3 * clamp(grain, -2.0, 2.0);
#endif

    float score = min(score_of(amount), largest_margin), margin = sheet.score + score;
    float film_variance = film_softness * film_softness;
    float unseen = max(1.0 - sheet.shown, 0.0);
    thick_score += 2.2 * surf;
    float cover = fraction_below((sheet.score + score * sqrt(1.0 + film_variance)) * inversesqrt(unseen + film_variance));
    float thick = fraction_below((margin + thick_score - thick_margin) * inversesqrt(unseen + thick_unseen));
    cover = mix(cover, amount, mean) * min(100.0 * amount, 1.0);
    thick = thickest * min(mix(thick, amount * mix(thick_in_mean, 0.6, surf), mean), cover);
#if STREAKS
    if (film > 0.0) {
        float gathered = fraction_below((rows.score + score_of(film)) * inversesqrt(max(1.0 - rows.shown, 0.1)));
        cover += gathered * (1.0 - cover);
    }
#endif
    foam.cover = cover;
    foam.thickness = thick / max(cover, 1e-4);
    foam.slopes += sheet.slopes;
    foam.hollow = mix(0.35, clamp(1.1 * hollow_score, 0.0, 1.0), hollow_shown);
    return foam;
}

// Returns the albedo, from a film of a few bubbles to thick foam in visible light, 0.7 at most
// (Whitlock et al. 1982; Koepke 1984).
float foam_albedo(float thickness) { return mix(0.07, 0.74, thickness); }

// Returns the light of water with bubbles below foam. Bubbles scatter white light, and the water
// absorbs red light.
vec3 light_of_plume(vec3 light_down) {
    const float bubbles_per_m = 0.15;  // backscattering of bubbles
    vec3 scattering = water_backscattering.rgb + bubbles_per_m;
    return light_down * (0.54 * 0.33 / pi) * scattering / (water_absorption.rgb + scattering);
}

// Adds foam to the radiance of a pixel of water.
vec3 with_foam(vec3 radiance, Foam foam, vec3 normal, vec3 to_eye, float fresnel) {
    float height = max(sun.y, 0.0);
    vec3 light_down = sunlight() * height + sky_irradiance.rgb;
    vec3 plume = light_of_plume(light_down);
    radiance = (radiance + plume * (0.15 * foam.plume * (1.0 - fresnel))) * (1.0 - 0.5 * foam.shade);
    if (foam.cover <= 0.0) return radiance;

    vec3 bumpy = normalize(normal - vec3(foam.slopes.x, 0.0, foam.slopes.y) * foam.thickness);
    // Light spreads in foam, so faces that point slightly away from the sun are lit too.
    const float spread = 0.25;
    float facing = max((dot(bumpy, sun.xyz) + spread) / (1.0 + spread), 0.0);
    // Light of a low sun does not reach hollows.
    float shadow = foam.hollow * foam.thickness;
    facing *= 1.0 - shadow * (1.0 - smoothstep(0.1, 0.9, height));
    float open = 0.5 + 0.5 * bumpy.y;
    vec3 light = (sunlight() * facing + sky_irradiance.rgb * open) * (1.0 - 0.6 * shadow);

    float albedo = foam_albedo(foam.thickness);
    // Wet bubbles reflect like rough water.
    float sheen = 0.5 * mean_fresnel(clamp(dot(bumpy, to_eye), 0.0, 1.0), 0.35);
    vec3 mirrored = sky_irradiance.rgb / pi * sheen + sunlight() * (0.5 * glint(bumpy, to_eye, 0.1));
    vec3 white = light * (albedo * (1.0 - sheen) / pi) + mirrored;
    vec3 below = plume * (1.0 - albedo) * (1.0 - albedo);
    return mix(radiance, (white + below) * foam.grain, foam.cover);
}
