// Foam: how much of a pixel lies under it, how thick it is there, and its light.
//
// The cascades' maps say how much foam there is (foam_maps.glsl), a texture says where it lies at three scales (gl/water/foam_image.hpp).
// Each scale hands its amount on to the next finer one and changes nothing of its mean, so the sea is as white as its maps are, from near
// and far. A value of a map is an age, too: 1 breaks now, 0.5 did so 1.4 s ago, and opens into threads.
//
// Whitlock, Bartlett and Gurganus 1982, "Sea foam reflectance and influence on optimum wavelength for remote sensing of ocean
// aerosols"; Koepke 1984, "Effective reflectance of oceanic whitecaps".
// A headset has one look-up: lace. MEDIUM: lace and streaks; HIGH: bubbles, too.
uniform highp sampler2DArray foam_structure;  // bubbles, lace, streaks

const int bubbles_layer = 0, lace_layer = 1, streaks_layer = 2;
const float foam_texels = 256.0;  // a side

struct Foam {
    float cover;      // part of the pixel
    float fresh;      // part of it that breaks now
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
vec4 structure(int layer, vec2 uv, float pixel_cascades) {
    vec4 texel = textureLod(foam_structure, vec3(uv, layer), log2(max(pixel_cascades * foam_texels, 1.0)) - 0.5);
    texel.yz = (texel.yz * 255.0 - 128.0) / 127.0;
    return texel;
}

// Streaks belong to the open sea.
#define STREAKS (SHADING >= MEDIUM && SURFACE == OPEN)
#define THREE_SCALES (SHADING == HIGH && SURFACE == OPEN)

#if STREAKS
vec4 streaks_at(int size, vec2 at, float pixel_m) {
    vec2 wind = waves.zw;
    vec4 place = foam_streaks[size];
    vec2 uv = vec2(dot(wind, at), wind.x * at.y - wind.y * at.x) * place.xy + place.zw;
    return structure(streaks_layer, uv, pixel_m * place.y);
}

#endif

// How much of the foam at a place is fresh. Of ages that are as many of each, so is a half.
float breaking_fraction(float part, float mean) { return mix(smoothstep(0.4, 1.0, part), 0.5, mean); }

// `crests`: part that is white of small water, or of dynamic waves.
Foam foam_at(vec2 at, float distance_m, float crests, vec3 to_eye) {
    Footprint pixel = footprint_of(at);
    float pixel_m = max(length(pixel.dx), length(pixel.dy));
    vec2 ragged = vec2(0.0);
#if STREAKS
    vec4 streaks = streaks_at(0, at, pixel_m);
    ragged = 0.5 * streaks.yz;
#endif
#if SURFACE == OPEN
    FoamOfCascades there = foam_of_maps(at, ragged, distance_m, pixel);
#ifdef DYNAMIC_WAVES
    there = with_foam_of(there, crests, log2(max(pixel.wide_m * dynamic_waves_place.w, 1e-3)), 1.0);
#endif
    float amount = there.part, freshness = breaking_fraction(there.part, there.mean), thickest = there.thick;
#else
    float amount = crests, freshness = 1.0, thickest = 1.0;
#endif
    float fresh = amount * freshness, plume = amount;
    // Where the eye is high above it, a thick crest of foam hides what lies behind it: what is seen lies nearer.
    vec2 behind = to_eye.xz / max(to_eye.y, 0.3);
    vec2 lace_uv = (at + behind * (foam_kind.z * fresh)) * noise_scale.y + foam_shift.zw;

#if THREE_SCALES
    // The third look-up is for what the pixel can show: bubbles near, the widest windrows far away.
    bool far = pixel_m > 0.35;
    vec4 third = far ? streaks_at(1, at, pixel_m)
                     : structure(bubbles_layer, at * noise_scale.x + foam_shift.xy, pixel_m * noise_scale.x);
    float broad = smoothstep(0.35, 1.5, pixel_m) * foam_kind.w * (1.0 - freshness);
    amount = mix(amount, gathered_in_pixel(amount, third.x, 0.4, pixel_m, 60.0), broad);
#endif
#if STREAKS
    amount = mix(gathered_in_pixel(amount, streaks.x, foam_kind.y, pixel_m, 3.0), amount, mix(0.5, 1.0, freshness));
    lace_uv += 0.30 * streaks.yz;
#endif

    vec4 lace = structure(lace_layer, lace_uv, pixel_m * noise_scale.y);
    float cover = gathered_in_pixel(amount, lace.x, mix(0.25, 0.35, freshness), pixel_m, 0.5);
    float thickness = thickest * (freshness * (0.55 + 0.45 * lace.x) + (1.0 - freshness) * (0.05 + 0.35 * lace.x * amount));
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
    return Foam(cover, fresh, thickness, plume, relief, hollow);
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
