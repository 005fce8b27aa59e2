// Stars as points: one in some cells of the faces of a cube, identical in every frame.

// Jarzynski and Olano 2020, "Hash Functions for GPU Rendering" (pcg3d).
uvec3 hashed(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v += v.yzx * v.zxy;
    v ^= v >> 16u;
    v += v.yzx * v.zxy;
    return v;
}

vec3 random_at(uvec3 v) { return vec3(hashed(v) >> 8u) / 16777216.0; }

// Returns the radiance of stars in a pixel. Each is a Gaussian spot with a standard deviation of
// 0.6 pixels, so its flux does not depend on the pixel size.
vec3 starlight(vec3 direction) {
    vec3 size = abs(direction);
    float most = max(size.x, max(size.y, size.z));
    int axis = most == size.y ? 1 : most == size.x ? 0 : 2;
    float ahead = axis == 1 ? direction.y : axis == 0 ? direction.x : direction.z;
    vec2 across = (axis == 1 ? direction.xz : axis == 0 ? direction.yz : direction.xy) / most;
    const float cells = 80.0;
    vec2 cell = floor((across * 0.5 + 0.5) * cells);
    uvec3 key = uvec3(uvec2(cell), uint(axis * 2 + (ahead > 0.0 ? 1 : 0)));
    vec3 place = random_at(key), kind = random_at(key + uvec3(97u, 0u, 0u));
    // The star keeps a distance from the edge of the cell, so that its spot fits.
    vec2 star_at = (cell + 0.2 + 0.6 * place.xy) / cells * 2.0 - 1.0;
    // Every third cell has a star, and fewer near the cube's corners, where cells cover a smaller
    // solid angle. The total is 7200 stars, about as many as are visible to the eye (Yale Bright
    // Star Catalogue: 9096 to magnitude 6.5).
    if (place.z > 0.36 * pow(1.0 + dot(star_at, star_at), -1.5)) return vec3(0.0);
    vec3 star = axis == 1 ? vec3(star_at.x, sign(ahead), star_at.y)
                          : axis == 0 ? vec3(sign(ahead), star_at) : vec3(star_at, sign(ahead));
    float pixel = max(max(length(dFdx(direction)), length(dFdy(direction))), 1e-5);
    float off = length(direction - normalize(star)) / pixel;
    // Each magnitude has 3.2 times as many stars as the previous one, down to 6.5 (Allen 1976), so
    // the flux is proportional to a uniform number to the power -0.8.
    float flux = min(0.0025 * pow(max(kind.x, 1e-5), -0.8), 4.0);
    vec3 tint = mix(vec3(1.15, 0.97, 0.75), vec3(0.82, 0.98, 1.35), kind.y);
    const float spread = 0.36;  // variance
    return tint * (stars.x * flux * exp(-0.5 * off * off / spread) / (6.2831853 * spread * pixel * pixel));
}
