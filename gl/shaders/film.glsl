// Conversion of radiance to screen colours; independent of the scene's uniforms.

// Rec. 709.
float luminance_of(vec3 colour) { return dot(colour, vec3(0.2126, 0.7152, 0.0722)); }

// Brightens shadows. Luminance y far below 0.25 becomes 0.25 (y / 0.25)^0.75; above, it changes
// little. The filmic curve alone darkens a luminance of 0.023 by 1.7 stops.
vec3 with_lifted_shadows(vec3 exposed) {
    float below = 0.25 / max(luminance_of(exposed), 1e-5);
    return exposed * pow(1.0 + below * below, 0.125);
}

// Tone curve: lifted shadows, then the filmic curve of the Academy's reference transform, in the
// fit by Stephen Hill (2016, in the BakingLab samples): sRGB to the working space, the curve, back
// to sRGB. gl/exposure.hpp has the curve for grey.
vec3 filmic(vec3 exposed) {
    const mat3 into = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 out_of = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    vec3 v = into * with_lifted_shadows(exposed);
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return clamp(out_of * v, 0.0, 1.0);
}

// IEC 61966-2-1.
vec3 srgb_encoded(vec3 linear) {
    return mix(12.92 * linear, 1.055 * pow(max(linear, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
}

// Noise of +-1/2 step, which hides the quantisation to 8 bits in a smooth sky. Interleaved gradient
// noise: Jimenez 2014, "Next Generation Post Processing in Call of Duty".
float dither(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5; }

// Multiplies a sample by a weight that falls with its luminance, and stores the weight in alpha
// (Karis 2013, "Tone Mapping"). Samples are averaged before the tone curve, and without weights
// bright glints would leave edges aliased. The display pass divides by alpha. The weight stays
// within the normal numbers of a half float. With `exposure` 0 all samples have the weight 1.
vec4 weighted_sample(vec3 radiance, float exposure) {
    vec3 held = min(radiance, vec3(6e4));
    float weight = 1.0 / (1.0 + min(exposure * luminance_of(held), 1023.0));
    return vec4(held * weight, weight);
}

// Blends to rod vision, which has no colour, in the dark. The blend depends on the luminance in
// cd/m^2 as in Krawczyk, Myszkowski and Seidel 2005, "Perceptual effects in real-time tone
// mapping". Rod vision appears blue, with the chromaticity (0.25, 0.25): Jensen et al. 2000, "Night
// Rendering".
vec3 night_vision(vec3 radiance, float luminance_of_unit) {
    float luminance = luminance_of(radiance);
    float rods = 0.04 / (0.04 + luminance * luminance_of_unit);
    return mix(radiance, luminance * vec3(0.706, 0.990, 1.966), rods);
}
