// Screen-space reflection of the scene that the application drew before the sea. The ray is traced
// through the image in steps of equal length on the screen (McGuire and Mara 2014, "Efficient GPU
// Screen-Space Ray Tracing"). The first step that ends behind the scene is refined by bisection. If
// there is no such step within the image, the sky is reflected.
uniform highp sampler2D scene_radiance;  // radiance times coverage; alpha: coverage
uniform highp sampler2D scene_depth;

// Returns the distance of the scene ahead of the eye, as w of clip coordinates.
float scene_ahead(vec2 on_screen) {
    float depth = textureLod(scene_depth, 0.5 + 0.5 * on_screen, 0.0).r;
    if (depth >= 1.0) return 1e9;
    highp mat4 m = viewer_from_clip[0];
    return 1.0 / dot(vec4(m[0].w, m[1].w, m[2].w, m[3].w), vec4(on_screen, 2.0 * depth - 1.0, 1.0));
}

// Returns the distance in metres until the ray leaves the image through an edge or the near plane.
// `start` is in clip coordinates, and `change` is their change per metre of the ray.
float path_in_image(vec4 start, vec4 change) {
    vec4 edges = vec4(start.w + start.x, start.w - start.x, start.w + start.y, start.w - start.y);
    vec4 nearer = vec4(change.w + change.x, change.w - change.x, change.w + change.y, change.w - change.y);
    vec4 paths = mix(vec4(1e4), edges / max(-nearer, 1e-6), vec4(lessThan(nearer, vec4(0.0))));
    float falls = change.z + change.w;
    float to_near = falls < 0.0 ? 0.9 * (start.z + start.w) / -falls : 1e4;
    return max(min(min(min(paths.x, paths.y), min(paths.z, paths.w)), min(to_near, 1e4)), 0.0);
}

// Returns the scene's radiance along a ray and its weight against the sky. `spread` is the angular
// width of the reflected image, radians.
vec4 scene_along(vec3 at, vec3 towards, float spread) {
    const int steps = 24, refinements = 4;
    vec4 start = clip_from_viewer[0] * vec4(at, 1.0), change = clip_from_viewer[0] * vec4(towards, 0.0);
    float path = path_in_image(start, change), end = start.w + path * change.w;
    float before = 0.0, behind = -1.0;
    for (int i = 1; i <= steps; ++i) {
        float fraction = float(i) / float(steps);
        float metres = path * fraction * start.w / mix(end, start.w, fraction);
        vec4 clip = start + metres * change;
        if (clip.w > scene_ahead(clip.xy / clip.w)) {
            behind = metres;
            break;
        }
        before = metres;
    }
    if (behind < 0.0) return vec4(0.0);
    for (int i = 0; i < refinements; ++i) {
        float middle = 0.5 * (before + behind);
        vec4 clip = start + middle * change;
        if (clip.w > scene_ahead(clip.xy / clip.w))
            behind = middle;
        else
            before = middle;
    }
    vec4 clip = start + behind * change;
    vec2 on_screen = clip.xy / clip.w;
    // If the ray is further behind the scene than the last step is long, it passes behind an
    // object.
    float thickness = 2.0 * (behind - before) + 0.005 * clip.w;
    if (clip.w - scene_ahead(on_screen) > thickness) return vec4(0.0);
    vec2 size = vec2(textureSize(scene_radiance, 0));
    highp mat4 m = clip_from_viewer[0];
    float pixels_per_metre = 0.5 * size.y * length(vec3(m[0].y, m[1].y, m[2].y)) / clip.w;
    vec4 seen = textureLod(scene_radiance, 0.5 + 0.5 * on_screen, log2(max(spread * behind * pixels_per_metre, 1.0)));
    vec2 to_edge = 1.0 - abs(on_screen);
    float inside = smoothstep(0.0, 0.15, min(to_edge.x, to_edge.y));
    return vec4(seen.rgb / max(seen.a, 1e-4), min(seen.a, 1.0) * inside);
}

// Returns the reflected light with the scene. `sky_light` is the reflected light without the scene,
// and `water_light` is the radiance of other waves without their reflection.
vec3 with_mirrored_scene(vec3 sky_light, vec3 at, vec3 normal, vec3 to_eye, float alpha2, vec3 water_light) {
    MeanMirror mirror = mean_mirror(normal, to_eye, alpha2, alpha_of_all_waves());
    vec4 scene = scene_along(at, normalize(mirror.towards), sqrt(mirror.alpha2));
    return mix(sky_light, mix(water_light, scene.rgb, mirror.sky_share), scene.a);
}
