// Lens near the water surface. A pixel is under water if its position on the near plane lies below
// the surface. Around the lens the surface is a plane, which the application computes by a query
// (DrawInput::camera_water_plane).

// Returns the row of the projection that gives w. A perspective measures the distance from the eye
// along it.
vec3 ahead_of_eye() {
    return vec3(clip_from_viewer[EYE][0][3], clip_from_viewer[EYE][1][3], clip_from_viewer[EYE][2][3]);
}

// Makes a ray point ahead. With multisampling, pixels whose centre is outside a triangle are shaded
// too. Near the horizon interpolation has then passed through infinity, and the ray from the eye
// points backwards.
vec3 leading_ahead(vec3 ray) { return dot(ray, ahead_of_eye()) < 0.0 ? -ray : ray; }

// Returns the height of the near plane above the water where the ray crosses it, metres; negative
// under water. The ray starts at the eye and may have any length.
float lens_above_water(vec3 ray) {
    if (lens.w <= 0.0) return 1e3;
    vec3 at = eye[EYE].xyz + leading_ahead(ray) * (lens.w / max(abs(dot(ray, ahead_of_eye())), 1e-6));
    return at.y - lens.x - dot(lens.yz, at.xz);
}

// Adds the meniscus of water on the glass: a dark rim, through which the deep water is seen, with
// light on its upper edge. It also hides aliasing between the views above and under water.
vec3 across_meniscus(vec3 radiance, float above) {
    float rim = above / (0.012 * max(lens.w, 1e-3));
    if (abs(rim) > 4.0) return radiance;
    vec3 edge_light = sky_irradiance.rgb * (0.12 * exp(-5.0 * (rim - 1.3) * (rim - 1.3)));
    return radiance * (1.0 - 0.8 * exp(-rim * rim)) + edge_light;
}
