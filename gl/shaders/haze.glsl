// The air between the sea and the eye.

// Where haze ends the view it has the sky's own colour at the horizon, so the two meet without a line. The second factor softens the
// last quarter of a degree, in which rows of pixels are kilometres apart.
vec3 through_haze(vec3 radiance, vec3 from_eye, float distance_m) {
    vec3 horizon = textureLod(sky, normalize(vec3(from_eye.x, 0.0, from_eye.z)), 0.0).rgb;
    float soft = distance_m / haze.w;
    vec3 left = exp(-haze.rgb * distance_m) * exp(-soft * soft);
    return mix(horizon, radiance, left);
}
