// Foam: how much of a pixel it covers, and its light. Koepke 1984 (whitecaps).

// Foam stays where the water folded while the crest moves on, so older foam is what the crest has left behind it: the
// Jacobian further down the wind, thinner the older, of the one tile whose waves are those that break. 1 + D_xx + D_zz is the
// Jacobian where all waves run one way.
float foam_behind_crests(vec2 at) {
    int tile = int(foam_trail.x);
    vec2 uv = place_in_tile(tile, at);
    float old = 0.0;
    float weight = 0.62;
    for (int i = 1; i <= 2 * SHADING; ++i) {
        vec2 d = texture(slopes, vec3(uv + foam_trail.zw * float(i), tile), 0.6 * float(i)).zw * signed_scale - signed_zero;
        old = max(old, weight * folding(tile_slope[tile].w, 1.0 + tile_slope[tile].x * (d.x + d.y), 1.0));
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

// Thick fresh foam reflects 0.6 and more, thin old foam less (Whitlock et al. 1982; Koepke 1984 has 0.55 in the mean).
vec3 foam_light(vec3 normal) {
    return (sun_irradiance.rgb * max(dot(normalize(normal + vec3(0.0, 0.5, 0.0)), sun.xyz), 0.0) +
            sky_irradiance.rgb * (0.5 + 0.5 * normal.y)) * (0.7 / pi);
}
