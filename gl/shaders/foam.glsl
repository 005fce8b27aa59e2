// Coverage, thickness and light of foam in a pixel.
//
// Snapshots of the cascades give the amount of foam (snapshot_foam.glsl), and a texture gives its
// structure at three scales (gl/water/foam_image.hpp). Each scale redistributes its amount to the
// next finer scale without a change of the mean, so the mean coverage is the same at any distance.
// The amount is also an age: foam of amount 1 is breaking now. Foam of amount 0.5 broke 1.4 s ago
// and opens into threads.
//
// Whitlock, Bartlett and Gurganus 1982, "Sea foam reflectance and influence on optimum wavelength
// for remote sensing of ocean aerosols"; Koepke 1984, "Effective reflectance of oceanic whitecaps".
// HEADSET samples lace only; MEDIUM samples lace and streaks; HIGH also samples bubbles.
uniform highp sampler2DArray foam_structure;  // bubbles, lace, streaks

const int bubbles_layer = 0, lace_layer = 1, streaks_layer = 2;
const float foam_texels = 256.0;  // texels along each axis
const float fresh_foam_m = 0.12;  // height of fresh foam above the water

struct Foam {
    float cover;      // covered fraction of the pixel
    float thickness;  // 0: a film of old bubbles, 1: fresh and opaque
    float plume;      // bubbles below the surface, 0 to 1
    vec2 slopes;      // slopes of the relief
    float hollow;     // 0 on top of the relief, 1 in its hollows
};

// Returns the coverage at a point of rank `rank` in [0, 1], if foam covers the fraction `amount` of
// all points. Points of the highest rank are covered first. The edge is 2 soft wide, at most 1. The
// mean over all ranks is exactly `amount`: the edge is moved where it would leave [0, 1].
float gathered(float amount, float rank, float soft) {
    float low = min(amount, 1.0 - amount);
    float inside = low < soft ? 2.0 * sqrt(soft * max(low, 0.0)) - soft : low;
    float edge = amount < 0.5 ? 1.0 - inside : inside;
    return clamp((rank - edge) / (2.0 * soft) + 0.5, 0.0, 1.0);
}

// Returns gathered() in a pixel of length pixel_m. Structure smaller than the pixel is replaced by
// its mean.
float gathered_in_pixel(float amount, float rank, float soft, float pixel_m, float scale_m) {
    float blur = pixel_m / scale_m;
    return mix(gathered(amount, rank, min(soft + 0.5 * blur, 0.5)), amount, smoothstep(0.4, 2.0, blur));
}

// Samples a layer and converts its signed bytes to [-1, 1]. The mip has texels of the pixel's
// length, but is half a level finer, because interpolation blurs ranks.
vec4 structure(int layer, vec2 uv, float pixel_cascades) {
    vec4 texel = textureLod(foam_structure, vec3(uv, layer), log2(max(pixel_cascades * foam_texels, 1.0)) - 0.5);
    texel.yz = (texel.yz * 255.0 - 128.0) / 127.0;
    return texel;
}

const float film_thickness = 0.1;

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

#endif

// Returns the fraction of the foam that is fresh. In a mean over uniformly distributed ages it is
// one half.
float breaking_fraction(float cover, float mean) { return mix(smoothstep(0.4, 1.0, cover), 0.5, mean); }

// Returns the foam of a pixel.
Foam foam_at(vec2 at, float distance_m, Waves surface, vec3 to_eye) {
    Footprint pixel = footprint_of(at);
    float pixel_m = max(length(pixel.dx), length(pixel.dy));
    vec2 ragged = vec2(0.0);
#if STREAKS
    vec4 streaks = streaks_at(0, at, pixel_m);
    ragged = 0.5 * streaks.yz;
#endif
#if SURFACE == OPEN
    FoamOfWaves there = foam_of_snapshots(at, distance_m, surface.compression, pixel.wide_m);
#ifdef SHORE
    there = with_foam_of_shore(there, ragged);
#endif
#ifdef DYNAMIC_WAVES
    there = with_foam_of(there, surface.crests, log2(max(pixel.wide_m * dynamic_waves_place.w, 1e-3)), 1.0);
#endif
    float amount = there.cover, freshness = breaking_fraction(there.cover, there.mean), thickest = there.thick;
    float dense = smoothstep(0.6, 0.8, amount) * (1.0 - there.mean);
#else
    float amount = surface.crests, freshness = 1.0, thickest = 1.0, dense = 0.0;
#endif
    float fresh = amount * freshness, plume = amount;
    // Fresh foam is raised, so the view ray meets it at an offset towards the eye.
    vec2 behind = to_eye.xz / max(to_eye.y, 0.3);
    vec2 lace_uv = (at + behind * (fresh_foam_m * fresh)) * noise_scale.y + foam_shift.zw;

#if THREE_SCALES
    // The third texture sample depends on the pixel size: bubbles near the eye, the widest windrows
    // far away.
    bool far = pixel_m > 0.35;
    vec4 third = far ? streaks_at(1, at, pixel_m)
                     : structure(bubbles_layer, at * noise_scale.x + foam_shift.xy, pixel_m * noise_scale.x);
    float broad = smoothstep(0.35, 1.5, pixel_m) * foam_kind.w * (1.0 - freshness);
    amount = mix(amount, gathered_in_pixel(amount, third.x, 0.4, pixel_m, 60.0), broad);
#endif
#if STREAKS
    // In a gale windrows gather films of old bubbles, which outlast the foam of the snapshots.
    float film = foam_kind.z;
#if THREE_SCALES
    film = mix(film, gathered_in_pixel(film, third.x, 0.4, pixel_m, 60.0), smoothstep(0.35, 1.5, pixel_m));
#endif
    film = gathered_in_pixel(film, streaks.x, 0.2, pixel_m, 3.0);
    amount = mix(gathered_in_pixel(amount, streaks.x, foam_kind.y, pixel_m, 3.0), amount, mix(0.5, 1.0, freshness));
    lace_uv += 0.30 * streaks.yz;
#endif

    vec4 lace = structure(lace_layer, lace_uv, pixel_m * noise_scale.y);
    // The edges of breaking crests are ragged already, so lace opens old foam only.
    float cover = mix(gathered_in_pixel(amount, lace.x, mix(0.25, 0.35, freshness), pixel_m, 0.5), amount, dense);
    float thickness = thickest * (freshness * (0.55 + 0.45 * lace.x) + (1.0 - freshness) * (0.05 + 0.35 * lace.x * amount));
#if STREAKS
    film = gathered_in_pixel(film, lace.x, 0.35, pixel_m, 0.5) * (1.0 - cover);
    thickness = mix(thickness, film_thickness, film / max(cover + film, 1e-4));
    cover += film;
#endif
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
    return Foam(cover, thickness, plume, relief, hollow);
}

// Returns the albedo, from 0.2 for a translucent film to 0.7 for thick foam in visible light
// (Whitlock et al. 1982; Koepke 1984).
float foam_albedo(float thickness) { return mix(0.2, 0.7, thickness); }

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
    radiance += plume * (0.6 * foam.plume * (1.0 - fresnel));
    if (foam.cover <= 0.0) return radiance;

    vec3 bumpy = normalize(normal - vec3(foam.slopes.x, 0.0, foam.slopes.y) * foam.thickness);
    // Light spreads in foam, so faces that point slightly away from the sun are lit too.
    const float spread = 0.25;
    float facing = max((dot(bumpy, sun.xyz) + spread) / (1.0 + spread), 0.0);
    // Light of a low sun does not reach hollows.
    float shadow = foam.hollow * foam.thickness;
    facing *= 1.0 - shadow * (1.0 - smoothstep(0.1, 0.9, height));
    float open = (0.5 + 0.5 * bumpy.y) * (1.0 - 0.35 * shadow);
    vec3 light = sunlight() * facing + sky_irradiance.rgb * open;

    float albedo = foam_albedo(foam.thickness);
    // Wet bubbles reflect like rough water.
    float sheen = 0.5 * mean_fresnel(clamp(dot(bumpy, to_eye), 0.0, 1.0), 0.35);
    vec3 mirrored = sky_irradiance.rgb / pi * sheen + sunlight() * (0.5 * glint(bumpy, to_eye, 0.1));
    vec3 white = light * (albedo * (1.0 - sheen) / pi) + mirrored;
    vec3 below = plume * (1.0 - albedo) * (1.0 - albedo);
    return mix(radiance, white + below, foam.cover);
}
