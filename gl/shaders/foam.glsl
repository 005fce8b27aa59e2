// Foam: how much of a pixel lies under it, how thick it is there, and its light.
//
// The waves say how much foam there is (waves.glsl: where they fold), a texture says where it lies at three scales
// (gl/foam_image.hpp). Each scale hands its amount on to the next finer one and changes nothing of its mean, so the sea is as white
// as its folds are, from near and far.
//
// Whitlock, Bartlett and Gurganus 1982, "Sea foam reflectance and influence on optimum wavelength for remote sensing of ocean
// aerosols"; Koepke 1984, "Effective reflectance of oceanic whitecaps".
// A headset has one look-up: lace. MEDIUM: lace, streaks and two looks at what crests left behind; HIGH: bubbles, too, and four.
uniform highp sampler2DArray foam_structure;  // bubbles, lace, streaks

const int bubbles_layer = 0, lace_layer = 1, streaks_layer = 2;
const float foam_texels = 256.0;  // a side

struct Foam {
    float cover;      // part of the pixel
    float thickness;  // 0: a film of old bubbles, 1: fresh and opaque
    float plume;      // bubbles below the surface, 0 to 1
    vec2 slopes;      // of its relief
    float hollow;     // 0 on top of the relief, 1 in its hollows
};

// The part of a place that foam covers where it covers the part `amount` of all places: those of the highest rank, from 0 to 1, with
// an edge as wide as 2 soft, at most 1. The mean over all ranks is `amount`, exactly: where the edge would leave [0, 1], it moves.
float gathered(float amount, float rank, float soft) {
    float low = min(amount, 1.0 - amount);
    float inside = low < soft ? 2.0 * sqrt(soft * max(low, 0.0)) - soft : low;
    float edge = amount < 0.5 ? 1.0 - inside : inside;
    return clamp((rank - edge) / (2.0 * soft) + 0.5, 0.0, 1.0);
}

// The same, seen by a pixel so long: structure that is finer than the pixel is only its mean.
float gathered_in_pixel(float amount, float rank, float soft, float pixel_m, float scale_m) {
    float blur = pixel_m / scale_m;
    return mix(gathered(amount, rank, min(soft + 0.5 * blur, 0.5)), amount, smoothstep(0.4, 2.0, blur));
}

// A layer, its signed bytes from -1 to 1. Texels as long as the pixel; half a level finer, because ranks blur when they are mixed.
vec4 structure(int layer, vec2 uv, float pixel_tiles) {
    vec4 texel = textureLod(foam_structure, vec3(uv, layer), log2(max(pixel_tiles * foam_texels, 1.0)) - 0.5);
    texel.yz = (texel.yz * 255.0 - 128.0) / 127.0;
    return texel;
}

// Streaks and trails belong to the open sea.
#define STREAKS (SHADING >= MEDIUM && SURFACE == OPEN)
#define THREE_SCALES (SHADING == HIGH && SURFACE == OPEN)

#if STREAKS
vec4 streaks_at(int size, vec2 at, float pixel_m) {
    vec2 wind = waves.zw;
    vec4 place = foam_streaks[size];
    vec2 uv = vec2(dot(wind, at), wind.x * at.y - wind.y * at.x) * place.xy + place.zw;
    return structure(streaks_layer, uv, pixel_m * place.y);
}

// Foam stays where the water folded while the crest moves on, so older foam is what the crest has left behind it: the
// Jacobian further down the wind, thinner the older, of the one tile whose waves are those that break. 1 + D_xx + D_zz is the
// Jacobian where all waves run one way. `ragged`, within [-1, 1], moves the looks, so that tails end in shreds.
// The first look is at the crest itself, as a whole: x of what returns. y: with what the crest has left.
vec2 foam_behind_crests(vec2 at, float ragged) {
    const int trail_looks = SHADING == HIGH ? 4 : 2;
    const float each = SHADING == HIGH ? 1.0 : 1.7;
    int tile = int(foam_trail.x);
    vec2 uv = place_in_tile(tile, at);
    vec2 found = vec2(0.0);
    float weight = 0.7;
    for (int i = 0; i < trail_looks; ++i) {
        float way = each * (float(i) + 0.45 * ragged);
        vec2 d = textureLod(slopes, vec3(uv + foam_trail.zw * way, tile), 0.6 * float(i)).zw * signed_scale - signed_zero;
        float folds = folding(tile_slope[tile].w, 1.0 + tile_slope[tile].x * (d.x + d.y), 0.0);
        if (i == 0) found.x = folds;
        found.y = max(found.y, weight * folds);
        weight *= SHADING == HIGH ? 0.72 : 0.52;
    }
    return found;
}
#endif

Foam foam_at(vec2 at, float fresh, vec3 to_eye) {
    Footprint pixel = footprint_of(at);
    float pixel_m = max(length(pixel.dx), length(pixel.dy));
    // Where the eye is high above it, a thick crest of foam hides what lies behind it: what is seen lies nearer.
    vec2 behind = to_eye.xz / max(to_eye.y, 0.3);
    vec2 lace_uv = (at + behind * (foam_kind.z * fresh)) * noise_scale.y + foam_shift.zw;

#if STREAKS
    vec4 streaks = streaks_at(0, at, pixel_m);
#if THREE_SCALES
    // The third look-up is for what the pixel can show: bubbles near, the widest windrows far away.
    bool far = pixel_m > 0.35;
    vec4 third = far ? streaks_at(1, at, pixel_m)
                     : structure(bubbles_layer, at * noise_scale.x + foam_shift.xy, pixel_m * noise_scale.x);
    float broad = smoothstep(0.35, 1.5, pixel_m);
#endif
    vec2 behind_crests = foam_behind_crests(at, streaks.y);
    float breaks = behind_crests.x, old = behind_crests.y;
    float strewn = foam_kind.x;
#if THREE_SCALES
    strewn = mix(strewn, gathered_in_pixel(strewn, third.x, 0.4, pixel_m, 60.0), broad);
#endif
    old = gathered_in_pixel(old, streaks.x, foam_kind.y, pixel_m, 3.0);
    strewn = gathered_in_pixel(strewn, streaks.x, 0.3, pixel_m, 3.0);
    lace_uv += 0.30 * streaks.yz;
#else
    float old = 0.0, strewn = 0.0, breaks = 1.0;
#endif
    old = 1.0 - (1.0 - old) * (1.0 - strewn);
    float amount = max(fresh, old);
    float freshness = fresh / max(amount, 1e-3);

    vec4 lace = structure(lace_layer, lace_uv, pixel_m * noise_scale.y);
    float cover = gathered_in_pixel(amount, lace.x, mix(0.10, 0.35, freshness), pixel_m, 0.5);
    float thickness = freshness * mix(0.7, 1.0, breaks) * (0.55 + 0.45 * lace.x) + (1.0 - freshness) * (0.05 + 0.35 * lace.x * amount);
    float near = 1.0 - smoothstep(0.02, 0.25, pixel_m);
    vec2 relief = lace.yz * (0.55 * near);
    float hollow = (1.0 - lace.x) * 0.6;
#if THREE_SCALES
    if (!far) {
        float seen = 1.0 - smoothstep(0.005, 0.06, pixel_m);
        cover = mix(cover, gathered(cover, third.x, 0.3), seen);
        relief += third.yz * (0.6 * seen);
        hollow = mix(hollow, hollow * 0.5 + 0.5 * (1.0 - third.w), seen);
        thickness *= 1.0 - 0.25 * seen * (1.0 - third.w);
    }
#endif
    return Foam(cover, thickness, smoothstep(0.0, 0.7, max(fresh, 0.8 * old)), relief, hollow);
}

// From a film through which the water shows to thick foam: 0.2 to 0.7 in the visible (Whitlock et al. 1982; Koepke 1984).
float foam_albedo(float thickness) { return mix(0.2, 0.7, thickness); }

// Water full of bubbles below foam: they scatter white light, the water takes the red out of it.
vec3 light_of_plume(vec3 light_down) {
    const float bubbles_per_m = 0.15;  // scattered backwards
    vec3 scattering = water_backscattering.rgb + bubbles_per_m;
    return light_down * (0.54 * 0.33 / pi) * scattering / (water_absorption.rgb + scattering);
}

// What a pixel of water shows with its foam.
vec3 with_foam(vec3 radiance, Foam foam, vec3 normal, vec3 to_eye, float fresnel) {
    float height = max(sun.y, 0.0);
    vec3 light_down = sun_irradiance.rgb * height + sky_irradiance.rgb;
    vec3 plume = light_of_plume(light_down);
    radiance += plume * (0.6 * foam.plume * (1.0 - fresnel));
    if (foam.cover <= 0.0) return radiance;

    vec3 bumpy = normalize(normal - vec3(foam.slopes.x, 0.0, foam.slopes.y) * foam.thickness);
    // Light spreads in foam, so that faces which look away from the sun are lit a little, too.
    const float spread = 0.25;
    float facing = max((dot(bumpy, sun.xyz) + spread) / (1.0 + spread), 0.0);
    // A low sun does not reach into hollows.
    float shadow = foam.hollow * foam.thickness;
    facing *= 1.0 - shadow * (1.0 - smoothstep(0.1, 0.9, height));
    float open = (0.5 + 0.5 * bumpy.y) * (1.0 - 0.35 * shadow);
    vec3 light = sun_irradiance.rgb * facing + sky_irradiance.rgb * open;

    float albedo = foam_albedo(foam.thickness);
    // Bubbles are wet: they mirror as water does, but as a rough thing.
    float sheen = 0.5 * mean_fresnel(clamp(dot(bumpy, to_eye), 0.0, 1.0), 0.35);
    vec3 mirrored = sky_irradiance.rgb / pi * sheen + sun_irradiance.rgb * (0.5 * glint(bumpy, to_eye, 0.1));
    vec3 white = light * (albedo * (1.0 - sheen) / pi) + mirrored;
    vec3 below = plume * (1.0 - albedo) * (1.0 - albedo);
    return mix(radiance, white + below, foam.cover);
}
