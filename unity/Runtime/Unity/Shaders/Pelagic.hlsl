// Surface of the open sea, the headset tier of Pelagic's OpenGL renderer (gl/shaders). Includes need
// none of Unity's headers. A shader that includes this file first defines
//
//   float3 PelagicSky(float3 direction, float roughness)
//
// which returns the radiance of the sky, blurred as by a mirror with alpha = roughness^2.
//
// Lengths are metres in the sea's axes: right-handed, y up, z is -z of the scene. Positions are
// relative to the viewer, so that floats suffice far from the origin. OceanSurface.cs sets the
// uniforms.
#ifndef PELAGIC_INCLUDED
#define PELAGIC_INCLUDED

#define PELAGIC_CASCADES 4       // the coarsest first
#define PELAGIC_FOAM_CASCADES 3  // the coarsest, whose compression makes foam
#ifndef PELAGIC_PATCHES
#define PELAGIC_PATCHES 511      // of one draw call: 16 KB
#endif

Texture2DArray _PelagicDisplacement;  // Dx, height, Dz
SamplerState sampler_PelagicDisplacement;
Texture2DArray _PelagicSlopes;        // h_x, h_z, D_xx, D_zz
SamplerState sampler_PelagicSlopes;
Texture2DArray _PelagicSnapshots;     // layer 3 i + j: image i of cascade j
SamplerState sampler_PelagicSnapshots;
Texture2D _PelagicRipples;            // slopes; alpha: fraction of the slopes that the mip resolves
SamplerState sampler_PelagicRipples;
Texture2D _PelagicLace;               // rank; slopes; score
SamplerState sampler_PelagicLace;

// xy: the viewer's texture coordinates; zw: cosine and sine of the rotation, divided by the side
float4 _PelagicCascadePlace[PELAGIC_CASCADES];
// x: texels per metre; y: the mip that resolves no wave
float4 _PelagicCascadeScale[PELAGIC_CASCADES];
// x: scale of slopes; z: slope variance of all waves
float4 _PelagicCascadeSlope[PELAGIC_CASCADES];
// xy: drift of the snapshots, texture coordinates; z: compression of a slope of 1; w: 1 with foam
float4 _PelagicFoamCascade[PELAGIC_FOAM_CASCADES];
float4 _PelagicFoamAge[2];
// x: compression at which half of the water is white
float4 _PelagicFoamKind;
// xy: factors of the slopes along x and z in the compression
float4 _PelagicFoamFront;
// xyz: position in the scene; w: height of still water there
float4 _PelagicViewer;
// xy: corner of the grid; z: metres per step; w: V
float4 _PelagicGrid;
// xy: centre of the fade; z: its end; w: 1 / (end - start)
float4 _PelagicFade;
// x: vertex spacing per metre of distance; y: minimum spacing; w: deepest level
float4 _PelagicMesh;
// direction towards the sun; irradiance perpendicular to its rays; irradiance of the sky
float4 _PelagicSun, _PelagicSunIrradiance, _PelagicSkyIrradiance;
// 1/m; w of the second: mean square slope of the ripples
float4 _PelagicAbsorption, _PelagicBackscattering;
// sunlight and skylight through crests, as in scene.glsl
float4 _PelagicCrestRay, _PelagicCrestSun, _PelagicCrestSky;
// x: significant wave height; y: alpha of waves that no cascade holds
float4 _PelagicWaves;
// xy: cosine and sine of the rotation of the ripples, divided by their period; zw: cosine and sine
float4 _PelagicRippleTurn;
// the viewer's texture coordinates: xy in the ripples, zw in the lace, which drifts
float4 _PelagicDetailPlace;

// Patches, two vectors each: corner in steps x and z, 2 level + parity of the diagonals, inner
// weight; then the weights of the edges +x, +z, -x, -z.
cbuffer PelagicPatches {
    float4 _PelagicPatches[2 * PELAGIC_PATCHES];
};

static const float pelagic_pi = 3.14159265;
static const float pelagic_water_index = 1.333;
static const float pelagic_lace_m = 17.0;

// ---- Cascades ----------------------------------------------------------------------------------

float2 PelagicInCascade(int cascade, float2 at) {
    float4 place = _PelagicCascadePlace[cascade];
    return place.xy + float2(place.z * at.x + place.w * at.y, place.z * at.y - place.w * at.x);
}

// Returns the weight of a cascade that is sampled at a mip.
float PelagicWeight(int cascade, float mip) { return saturate(_PelagicCascadeScale[cascade].y - mip); }

float PelagicViewerHeight() { return _PelagicViewer.y - _PelagicViewer.w; }

// ---- Vertices: sea.vert.glsl -------------------------------------------------------------------

struct PelagicVertex {
    float3 place;     // relative to the viewer
    float2 rest;      // undisplaced position
    float4 coarsest;  // slopes of the coarsest cascade, whose waves are long
};

float PelagicSpacing(float2 at) {
    return max(_PelagicMesh.y, length(float3(at.x, PelagicViewerHeight(), at.y)) * _PelagicMesh.x);
}

float3 PelagicDisplaced(int2 index) {
    float2 at = _PelagicGrid.xy + float2(index) * _PelagicGrid.z;
    float2 from_centre = abs(at - _PelagicFade.xy);
    float fade = saturate((_PelagicFade.z - max(from_centre.x, from_centre.y)) * _PelagicFade.w);
    float spacing = PelagicSpacing(at);
    float3 moved = 0;
    for (int cascade = 0; cascade < PELAGIC_CASCADES; ++cascade) {
        float weight = PelagicWeight(cascade, max(log2(spacing * _PelagicCascadeScale[cascade].x) - 0.5, 0.0));
        if (weight > 0.0)
            moved += weight * _PelagicDisplacement.SampleLevel(sampler_PelagicDisplacement, float3(PelagicInCascade(cascade, at), cascade), 0.0).xyz;
    }
    return moved * fade;
}

// Returns vertex (i, j) of a patch. The displacement of vertices that the next coarser level lacks
// morphs to the mean of two of its vertices.
PelagicVertex PelagicVertexOf(uint number, int2 ij) {
    float4 instance = _PelagicPatches[2 * number], edges = _PelagicPatches[2 * number + 1];
    int last = int(_PelagicGrid.w), level = int(instance.z) >> 1, diagonals = int(instance.z) & 1;
    int stride = 1 << (int(_PelagicMesh.w) - level);
    int2 index = int2(instance.xy) + ij * stride;
    float3 moved = PelagicDisplaced(index);

    int2 odd = ij & 1;
    if (odd.x != 0 || odd.y != 0) {
        float weight = instance.w;
        if (ij.x == 0) weight = edges.z;
        if (ij.x == last) weight = edges.x;
        if (ij.y == 0) weight = edges.w;
        if (ij.y == last) weight = edges.y;
        int2 offset = odd;
        if (odd.x == 1 && odd.y == 1 && (((ij.x >> 1) + (ij.y >> 1) + diagonals) & 1) != 0) offset.y = -1;
        offset *= stride;
        if (weight < 1.0) moved = lerp(0.5 * (PelagicDisplaced(index - offset) + PelagicDisplaced(index + offset)), moved, weight);
    }

    PelagicVertex vertex;
    vertex.rest = _PelagicGrid.xy + float2(index) * _PelagicGrid.z;
    float mip = max(log2(PelagicSpacing(vertex.rest) * _PelagicCascadeScale[0].x), 0.0);
    float4 texel = _PelagicSlopes.SampleLevel(sampler_PelagicSlopes, float3(PelagicInCascade(0, vertex.rest), 0.0), mip) * (255.0 / 127.0) - 128.0 / 127.0;
    vertex.coarsest = texel * (_PelagicCascadeSlope[0].x * PelagicWeight(0, mip));
    vertex.place = float3(vertex.rest.x + moved.x, moved.y - PelagicViewerHeight(), vertex.rest.y + moved.z);
    return vertex;
}

// ---- Waves in a pixel: waves.glsl --------------------------------------------------------------

struct PelagicFootprint {
    float length_m;  // the longer side
    float wide_m;    // width of a sample
    float ripple_m;  // width of a sample of ripples
};

PelagicFootprint PelagicFootprintOf(float2 rest) {
    float2 dx = ddx(rest), dy = ddy(rest);
    float x2 = dot(dx, dx), y2 = dot(dy, dy);
    PelagicFootprint pixel;
    pixel.length_m = sqrt(max(x2, y2));
    pixel.wide_m = max(sqrt(sqrt(x2 * y2)), 0.25 * max(pixel.length_m, 1e-6));
    pixel.ripple_m = 1.45 * max(sqrt(min(x2, y2)), 0.5 * pixel.length_m) + 1e-6;
    return pixel;
}

struct PelagicWaves {
    float2 slopes;      // with the sign of the normal
    float alpha2;       // mean square of the slopes that the pixel does not resolve
    float compression;  // in standard deviations
};

PelagicWaves PelagicWavesAt(float2 at, float4 coarsest, PelagicFootprint pixel) {
    float2 h = coarsest.xy, d = coarsest.zw;
    float variance = 0.0;
    PelagicWaves seen;
    seen.compression = -_PelagicFoamCascade[0].z * (d.x + d.y + dot(_PelagicFoamFront.xy, h));
    for (int cascade = 1; cascade < PELAGIC_CASCADES; ++cascade) {
        float4 scale = _PelagicCascadeScale[cascade];
        float mip = log2(pixel.wide_m * scale.x);
        float4 texel = _PelagicSlopes.SampleLevel(sampler_PelagicSlopes, float3(PelagicInCascade(cascade, at), cascade), mip) * (255.0 / 127.0) - 128.0 / 127.0;
        texel *= PelagicWeight(cascade, mip) * _PelagicCascadeSlope[cascade].x;
        h += texel.xy;
        d += texel.zw;
        variance += _PelagicCascadeSlope[cascade].z * saturate(mip / scale.y);
        if (cascade < PELAGIC_FOAM_CASCADES)
            seen.compression -= _PelagicFoamCascade[cascade].z * (texel.z + texel.w + dot(_PelagicFoamFront.xy, texel.xy));
    }
    // VR Ocean, equation 48; headsets omit D_xz.
    float3 normal = float3(-h.x * (1.0 + d.y), (1.0 + d.x) * (1.0 + d.y), -h.y * (1.0 + d.x));
    seen.slopes = normal.xz / max(normal.y, 0.2 * length(normal));

    // Ripples show a fraction of the roughness as slopes where pixels are small enough.
    float4 turn = _PelagicRippleTurn;
    float2 uv = float2(turn.x * at.x + turn.y * at.y, turn.x * at.y - turn.y * at.x) + _PelagicDetailPlace.xy;
    float mip = log2(pixel.ripple_m * length(turn.xy) * 256.0);
    float4 ripples = _PelagicRipples.SampleLevel(sampler_PelagicRipples, uv, mip);
    float shown = saturate(7.0 - mip), mean_square = _PelagicBackscattering.w;
    float2 slopes = (ripples.xy * 2.0 - 1.0) * (shown * sqrt(2.0));
    seen.slopes += sqrt(mean_square * 0.5) * 4.0 * float2(turn.z * slopes.x - turn.w * slopes.y, turn.w * slopes.x + turn.z * slopes.y);
    float rest = max(_PelagicWaves.y * _PelagicWaves.y - mean_square, 0.0);
    seen.alpha2 = clamp(variance + rest + mean_square * (1.0 - ripples.w * shown), 0.0004, 1.0);
    return seen;
}

// ---- Reflection: mirror.glsl -------------------------------------------------------------------

float PelagicFresnel(float cosine) {
    float g = sqrt(pelagic_water_index * pelagic_water_index - 1.0 + cosine * cosine);
    float a = (g - cosine) / (g + cosine), b = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

// Facets visible to the eye: mean slope towards it, mean cosine, and the variance of the cosine.
struct PelagicFacets {
    float slope, cosine, cosine_variance;
};

PelagicFacets PelagicSeenFacets(float mu, float s) {
    float spread = max(s * sqrt(max(1.0 - mu * mu, 0.0)), 1e-4);
    float a = clamp(mu / spread, -2.0, 1e4);
    float density = 0.3989423 * exp(-0.5 * a * a);
    float distribution = 1.0 / (1.0 + exp(-1.5976 * a - 0.070566 * a * a * a));
    float q = distribution / max(a * distribution + density, 1e-4);
    PelagicFacets seen;
    seen.slope = s * q;
    seen.cosine = spread * (a + q);
    seen.cosine_variance = spread * spread * max(2.0 - a * q - q * q, 0.0);
    return seen;
}

float PelagicFresnelOf(PelagicFacets seen, float s) {
    return PelagicFresnel(saturate(seen.cosine * (1.0 - 1.2 * s * s) - 2.5 * seen.cosine_variance));
}

float PelagicMeanFresnel(float cosine, float s) { return PelagicFresnelOf(PelagicSeenFacets(cosine, s), s); }

float PelagicMaskedArea(float cosine, float alpha) {
    float across = alpha * sqrt(max(1.0 - cosine * cosine, 1e-6));
    float a = cosine / across;
    return a < 1.6 ? across * (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 + 2.181 * a) : 0.0;
}

float PelagicLitFraction(float eye_cosine, float light_cosine, float alpha_of_all) {
    float eye_height = max(eye_cosine, 1e-3), light_height = max(light_cosine, 1e-4);
    float seen = (eye_height + PelagicMaskedArea(eye_height, alpha_of_all)) * light_height;
    return seen / (seen + PelagicMaskedArea(light_height, alpha_of_all) * eye_height);
}

float PelagicAlphaOfAll() {
    float square = _PelagicWaves.y * _PelagicWaves.y;
    for (int cascade = 0; cascade < PELAGIC_CASCADES; ++cascade) square += _PelagicCascadeSlope[cascade].z;
    return sqrt(square);
}

// Returns the glint of the sun for irradiance 1.
float PelagicGlint(float3 normal, float3 to_eye, float alpha2, float alpha_of_all) {
    float3 to_light = _PelagicSun.xyz;
    if (dot(normal, to_light) <= 0.0) return 0.0;
    float3 middle = to_light + to_eye;
    middle /= max(length(middle), 1e-4);
    float cosine2 = clamp(dot(normal, middle), 1e-3, 1.0);
    cosine2 *= cosine2;
    float distribution = exp((cosine2 - 1.0) / (cosine2 * alpha2)) / (pelagic_pi * alpha2 * cosine2 * cosine2);
    float nv = max(dot(normal, to_eye), 1e-3);
    return distribution * PelagicFresnel(saturate(dot(middle, to_eye))) * PelagicLitFraction(to_eye.y, to_light.y, alpha_of_all) /
           (4.0 * (nv + PelagicMaskedArea(nv, sqrt(alpha2))));
}

// Returns the reflected light of a pixel. `water_light` is that of other waves without reflection.
float3 PelagicMirroredLight(float3 normal, float3 to_eye, float alpha2, float alpha_of_all, float3 water_light) {
    float mu = dot(normal, to_eye);
    float3 along = to_eye - normal * mu;
    float t = max(length(along), 1e-4), s = sqrt(0.5 * alpha2);
    PelagicFacets seen = PelagicSeenFacets(mu, s);
    float cosine = min(seen.cosine, 1.0);
    float slope = seen.slope - 6.0 * (1.0 - cosine * cosine) * seen.cosine_variance / t;
    float3 towards = reflect(-to_eye, normalize(normal + along / t * clamp(slope, 0.0, 1.5)));
    float in_plane = seen.cosine_variance / max(s * s * t * t, 1e-8);
    float x = max(mu, 0.0) / sqrt(alpha2);
    float lit = PelagicLitFraction(to_eye.y, towards.y, alpha_of_all) * (1.0 - (0.1 + 0.3 * sqrt(alpha2)) * x * exp((1.0 - x * sqrt(x)) / 1.5));

    // A ray that meets another wave is reflected there again.
    float s_of_all = alpha_of_all * sqrt(0.5);
    PelagicFacets met = PelagicSeenFacets(-towards.y, s_of_all);
    float2 ahead = towards.xz / max(length(towards.xz), 1e-4);
    float3 second = reflect(towards, normalize(float3(-ahead.x * met.slope, 1.0, -ahead.y * met.slope)));
    second.y = max(second.y, 0.02);

    float mirror_alpha2 = 0.69 * alpha2 * 0.5 * (in_plane + cosine * cosine);
    float3 sky = PelagicSky(lerp(second, towards, lit), sqrt(sqrt(mirror_alpha2)));
    return lerp(water_light, sky, lerp(PelagicFresnelOf(met, s_of_all), 1.0, lit));
}

// ---- Light from the water: water_light.glsl, water.glsl ----------------------------------------

float3 PelagicAttenuation() { return _PelagicAbsorption.rgb + _PelagicBackscattering.rgb; }

float PelagicCosineInWater(float cosine) { return sqrt(1.0 - (1.0 - cosine * cosine) / (pelagic_water_index * pelagic_water_index)); }

float3 PelagicUpwelling(float3 normal, float3 to_eye, float2 long_slopes) {
    float high = max(dot(normalize(float3(-long_slopes.x, 1.0, -long_slopes.y)), _PelagicSun.xyz), 0.0);
    float3 sunlight = _PelagicSunIrradiance.rgb * high * (1.0 - PelagicMeanFresnel(high, 0.15));
    float3 skylight = 0.934 * _PelagicSkyIrradiance.rgb;
    float seen = max(-refract(-to_eye, normal, 1.0 / pelagic_water_index).y, 0.1);
    return 0.57 / (pelagic_pi * pelagic_water_index * pelagic_water_index) * _PelagicBackscattering.rgb / PelagicAttenuation() *
           (sunlight / (PelagicCosineInWater(max(_PelagicSun.y, 0.0)) + seen) + skylight / (0.86 + seen));
}

float3 PelagicThroughCrests(float3 normal, float3 to_eye, float height, float lip) {
    float steep = dot(normal.xz, _PelagicCrestRay.xz), away = saturate(6.0 * steep);
    lip *= saturate(2.5 * steep);
    float narrow = max(1.0 + dot(refract(-to_eye, normal, 1.0 / pelagic_water_index), _PelagicCrestRay.xyz), 0.1);
    float scattered = max(0.27 * rsqrt(narrow * narrow * narrow) - 0.18, 0.0);
    float depth = max(0.31 * _PelagicWaves.x - height, 0.0);
    float3 k = PelagicAttenuation();
    float3 path = min(0.6 + 0.7 * _PelagicWaves.x * k, 1.0) / k;
    return away * (_PelagicBackscattering.rgb * path * exp(k * (depth * _PelagicCrestRay.w)) + 2.7 * lip * exp(-1.5 * k)) * (scattered * _PelagicCrestSun.rgb + _PelagicCrestSky.rgb);
}

// ---- Foam: snapshot_foam.glsl, foam.glsl -------------------------------------------------------

// Returns the fraction of the water that is white. Without the mean over what wide pixels do not
// resolve.
float PelagicFoamCover(float2 at, float present, float wide_m, float torn, float spread) {
    if (_PelagicFoamKind.x >= 1000.0) return 0.0;
    float4 first = 0, second = 0;
    for (int cascade = 0; cascade < PELAGIC_FOAM_CASCADES; ++cascade) {
        float mip = log2(max(wide_m, 0.2) * _PelagicCascadeScale[cascade].x);
        float weight = _PelagicFoamCascade[cascade].w * PelagicWeight(cascade, mip);
        float2 uv = PelagicInCascade(cascade, at) - _PelagicFoamCascade[cascade].xy;
        if (weight > 0.0) {
            first += weight * (8.0 * _PelagicSnapshots.SampleLevel(sampler_PelagicSnapshots, float3(uv, cascade), mip) - 3.0);
            second += weight * (8.0 * _PelagicSnapshots.SampleLevel(sampler_PelagicSnapshots, float3(uv, PELAGIC_FOAM_CASCADES + cascade), mip) - 3.0);
        }
    }
    float scale = 1.0 / (0.3 * spread), offset = 0.5 + torn * scale - _PelagicFoamKind.x / 0.3;
    first = saturate(offset + first * scale) - _PelagicFoamAge[0];
    second = saturate(offset + second * scale) - _PelagicFoamAge[1];
    float4 largest = max(first, second);
    return max(saturate(offset + present * scale), max(max(largest.x, largest.y), max(largest.z, largest.w)));
}

float PelagicScoreOf(float fraction) {
    float f = clamp(fraction, 1e-4, 0.9999);
    float log_f = log(4.0 * f * (1.0 - f)), t = 4.3307 + 0.5 * log_f;
    return sign(f - 0.5) * sqrt(max(2.0 * (sqrt(t * t - log_f / 0.147) - t), 0.0));
}

float PelagicFractionBelow(float x) { return 1.0 / (1.0 + exp(-x * (1.5976 + 0.070566 * x * x))); }

// Slopes of the lace, and its score. The lace is sampled at its middle scale.
float3 PelagicLaceAt(float2 at, float pixel_m) {
    float2 uv = at / pelagic_lace_m + _PelagicDetailPlace.zw;
    uv = float2(3.0 * uv.x - 2.0 * uv.y, 2.0 * uv.x + 3.0 * uv.y);
    float3 texel = _PelagicLace.SampleLevel(sampler_PelagicLace, uv, log2(max(pixel_m / pelagic_lace_m * 3.6055513 * 256.0, 1.0)) - 0.5).yzw;
    texel = (texel * 255.0 - 128.0) / 127.0;
    return float3(float2(3.0 * texel.x + 2.0 * texel.y, 3.0 * texel.y - 2.0 * texel.x) / 3.6055513, 3.2 * texel.z);
}

// Adds foam to the radiance of a pixel of water.
float3 PelagicWithFoam(float3 radiance, float3 lace, float amount, float pixel_m, float3 normal, float3 to_eye, float mirrors, float alpha_of_all) {
    float height = max(_PelagicSun.y, 0.0);
    float3 light_down = _PelagicSunIrradiance.rgb * height + _PelagicSkyIrradiance.rgb;
    float3 scattering = _PelagicBackscattering.rgb + 0.15;  // of bubbles, 1/m
    float3 plume = light_down * (0.54 * 0.33 / pelagic_pi) * scattering / (_PelagicAbsorption.rgb + scattering);
    radiance += plume * (0.15 * amount * (1.0 - mirrors));
    if (amount <= 0.0) return radiance;

    float shown = saturate(1.0 - pixel_m / 0.6), score = 0.97 * sqrt(shown) * lace.z;
    float margin = score + min(PelagicScoreOf(amount), 3.7), unseen = 1.0 - 0.9409 * shown;
    float spread = score + 1.14127 * min(PelagicScoreOf(amount), 3.7);
    float cover = PelagicFractionBelow(spread * rsqrt(unseen + 0.3025)) * min(100.0 * amount, 1.0);
    float thickness = min(PelagicFractionBelow((margin - 3.0) * rsqrt(unseen + 0.69)), cover) / max(cover, 1e-4);
    float2 relief = (0.9 * shown) * lace.xy;
    float hollow = lerp(0.35, saturate(-0.55 * lace.z), shown);

    float3 bumpy = normalize(normal - float3(relief.x, 0.0, relief.y) * thickness);
    float shadow = hollow * thickness;
    float facing = max((dot(bumpy, _PelagicSun.xyz) + 0.25) / 1.25, 0.0) * (1.0 - shadow * (1.0 - smoothstep(0.1, 0.9, height)));
    float open = 0.5 + 0.5 * bumpy.y;
    float3 light = (_PelagicSunIrradiance.rgb * facing + _PelagicSkyIrradiance.rgb * open) * (1.0 - 0.6 * shadow);
    float albedo = lerp(0.07, 0.74, thickness);
    float sheen = 0.5 * PelagicMeanFresnel(saturate(dot(bumpy, to_eye)), 0.35);
    float3 mirrored = _PelagicSkyIrradiance.rgb / pelagic_pi * sheen + _PelagicSunIrradiance.rgb * (0.5 * PelagicGlint(bumpy, to_eye, 0.1, alpha_of_all));
    float3 white = light * (albedo * (1.0 - sheen) / pelagic_pi) + mirrored;
    return lerp(radiance, white + plume * (1.0 - albedo) * (1.0 - albedo), cover);
}

// ---- Pixels: sea.frag.glsl ---------------------------------------------------------------------

// Returns the radiance of a pixel, without haze. eye: its position relative to the viewer.
float3 PelagicRadiance(PelagicVertex pixel, float3 eye) {
    float3 to_eye = normalize(eye - pixel.place);
    PelagicFootprint footprint = PelagicFootprintOf(pixel.rest);
    PelagicWaves waves = PelagicWavesAt(pixel.rest, pixel.coarsest, footprint);
    float3 normal = normalize(float3(waves.slopes.x, 1.0, waves.slopes.y));
    float alpha_of_all = PelagicAlphaOfAll();
    float mirrors = PelagicMeanFresnel(saturate(dot(normal, to_eye)), sqrt(0.5 * waves.alpha2));
    float height = pixel.place.y + PelagicViewerHeight();
    float lip = smoothstep(max(_PelagicFoamKind.x - 1.5, 0.8), max(_PelagicFoamKind.x - 0.2, 1.8), waves.compression) *
                smoothstep(0.05, 0.35, height / _PelagicWaves.x);
    float3 water_light = PelagicUpwelling(normal, to_eye, pixel.coarsest.xy) + PelagicThroughCrests(normal, to_eye, height, lip);
    float3 mirrored = PelagicMirroredLight(normal, to_eye, waves.alpha2, alpha_of_all, water_light);
    float3 radiance = lerp(water_light, mirrored, mirrors) + _PelagicSunIrradiance.rgb * PelagicGlint(normal, to_eye, waves.alpha2, alpha_of_all);
    float3 lace = PelagicLaceAt(pixel.rest, footprint.length_m);
    float shown = saturate(1.0 - footprint.length_m / 0.6);
    float foam = PelagicFoamCover(pixel.rest + float2(0.12, 0.09) * lace.z, waves.compression, footprint.wide_m,
                                  0.45 * 0.97 * sqrt(shown) * lace.z, sqrt(1.0 + 0.2025 * 0.9409 * shown));
    return PelagicWithFoam(radiance, lace, foam, footprint.length_m, normal, to_eye, mirrors, alpha_of_all);
}

#endif
