// What an application drew before the sea, mirrored: the ray is followed through its image, in steps that are even on the screen (McGuire and
// Mara 2014, "Efficient GPU Screen-Space Ray Tracing"). The first step that ends behind what stands there is halved until the place is
// found. Where there is none, or the ray leaves the image, the sky is mirrored.
uniform highp sampler2D scene_radiance;  // times coverage; alpha: coverage
uniform highp sampler2D scene_depth;

// How far ahead of the eye the scene stands there, as clip coordinates' w.
float scene_ahead(vec2 on_screen) {
    float depth = textureLod(scene_depth, 0.5 + 0.5 * on_screen, 0.0).r;
    if (depth >= 1.0) return 1e9;
    highp mat4 m = viewer_from_clip[0];
    return 1.0 / dot(vec4(m[0].w, m[1].w, m[2].w, m[3].w), vec4(on_screen, 2.0 * depth - 1.0, 1.0));
}

// `start`, `change`: clip coordinates, and what a metre of the ray adds.
// Metres until the ray leaves the image, through one of its edges or the near plane.
float way_in_image(vec4 start, vec4 change) {
    vec4 edges = vec4(start.w + start.x, start.w - start.x, start.w + start.y, start.w - start.y);
    vec4 nearer = vec4(change.w + change.x, change.w - change.x, change.w + change.y, change.w - change.y);
    vec4 ways = mix(vec4(1e4), edges / max(-nearer, 1e-6), vec4(lessThan(nearer, vec4(0.0))));
    float falls = change.z + change.w;
    float to_near = falls < 0.0 ? 0.9 * (start.z + start.w) / -falls : 1e4;
    return max(min(min(min(ways.x, ways.y), min(ways.z, ways.w)), min(to_near, 1e4)), 0.0);
}

// Radiance along a ray, and how much it counts against the sky's. `spread`: how wide the facets' image is, radians.
vec4 scene_along(vec3 at, vec3 towards, float spread) {
    const int steps = 24, refinements = 4;
    vec4 start = clip_from_viewer[0] * vec4(at, 1.0), change = clip_from_viewer[0] * vec4(towards, 0.0);
    float way = way_in_image(start, change), end = start.w + way * change.w;
    float before = 0.0, behind = -1.0;
    for (int i = 1; i <= steps; ++i) {
        float part = float(i) / float(steps);
        float metres = way * part * start.w / mix(end, start.w, part);
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
    // Further behind than the last step led: the ray passes what hides it there.
    float thickness = 2.0 * (behind - before) + 0.005 * clip.w;
    if (clip.w - scene_ahead(on_screen) > thickness) return vec4(0.0);
    vec2 size = vec2(textureSize(scene_radiance, 0));
    highp mat4 m = clip_from_viewer[0];
    float pixels_a_metre = 0.5 * size.y * length(vec3(m[0].y, m[1].y, m[2].y)) / clip.w;
    vec4 seen = textureLod(scene_radiance, 0.5 + 0.5 * on_screen, log2(max(spread * behind * pixels_a_metre, 1.0)));
    vec2 to_edge = 1.0 - abs(on_screen);
    float inside = smoothstep(0.0, 0.15, min(to_edge.x, to_edge.y));
    return vec4(seen.rgb / max(seen.a, 1e-4), min(seen.a, 1.0) * inside);
}

// `sky_light`: what is mirrored where the ray meets nothing; `water_light`: what other waves show where they mirror nothing
vec3 with_mirrored_scene(vec3 sky_light, vec3 at, vec3 normal, vec3 to_eye, float alpha2, vec3 water_light) {
    MeanMirror mirror = mean_mirror(normal, to_eye, alpha2, alpha_of_all_waves());
    vec4 scene = scene_along(at, normalize(mirror.towards), sqrt(mirror.alpha2));
    return mix(sky_light, mix(water_light, scene.rgb, mirror.sky_share), scene.a);
}
