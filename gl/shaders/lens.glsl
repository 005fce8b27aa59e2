// The lens and the water's surface: a pixel looks from within the water where its place on the near plane lies below the
// surface, which around the lens is the plane that the application asked a query for (DrawInput::camera_water_plane).

// The row of the projection that makes w: along it a perspective measures distance from the eye.
vec3 ahead_of_eye() {
    return vec3(clip_from_viewer[EYE][0][3], clip_from_viewer[EYE][1][3], clip_from_viewer[EYE][2][3]);
}

// Smoothed edges ask for pixels whose middle is beside a triangle: near the horizon interpolation has gone through infinity
// there, and the way from the eye leads backwards.
vec3 leading_ahead(vec3 ray) { return dot(ray, ahead_of_eye()) < 0.0 ? -ray : ray; }

// How far the lens stands above the water where the ray goes through it, metres; negative within the water.
// The ray leads away from the eye and may have any length.
float lens_above_water(vec3 ray) {
    if (lens.w <= 0.0) return 1e3;
    vec3 at = eye[EYE].xyz + leading_ahead(ray) * (lens.w / max(abs(dot(ray, ahead_of_eye())), 1e-6));
    return at.y - lens.x - dot(lens.yz, at.xz);
}

// Water climbs up the glass: a dark rim, through which one sees down into the water, with light on its upper edge. It also
// hides where two worlds meet within one pixel.
vec3 across_meniscus(vec3 radiance, float above) {
    float rim = above / (0.012 * max(lens.w, 1e-3));
    if (abs(rim) > 4.0) return radiance;
    vec3 edge_light = sky_irradiance.rgb * (0.12 * exp(-5.0 * (rim - 1.3) * (rim - 1.3)));
    return radiance * (1.0 - 0.8 * exp(-rim * rim)) + edge_light;
}
