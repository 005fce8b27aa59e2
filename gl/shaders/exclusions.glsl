// Water inside the interiors of hulls, which is not drawn (gl/water/exclusions.hpp).
uniform highp sampler2DArray exclusion_maps;  // x, y: lowest and highest point; z: covered fraction

// Returns the position in the box around an interior; in [0, 1] along each axis inside.
vec3 place_in_box(int hull, vec3 at) {
    vec4 position = vec4(at, 1.0);
    return vec3(dot(exclusion_box[3 * hull], position), dot(exclusion_box[3 * hull + 1], position),
                dot(exclusion_box[3 * hull + 2], position));
}

bool is_in_box(vec3 in_box) {
    vec3 from_middle = abs(in_box - 0.5);
    return max(from_middle.x, max(from_middle.y, from_middle.z)) <= 0.5;
}

bool is_in_interior(int hull, vec3 in_box) {
    vec3 map = exclusion_map[hull].xyz;
    // A border of one texel surrounds the cells of a map.
    vec2 place = (in_box.xz * map.xy + 1.0) / vec2(textureSize(exclusion_maps, 0).xy);
    vec3 range = textureLod(exclusion_maps, vec3(place, map.z), 0.0).xyz;
    return range.z > 0.5 && in_box.y > range.x && in_box.y < range.y;
}

// Returns whether a position relative to the viewer is in an interior. Where boxes overlap, the
// first two are sampled.
bool is_excluded(vec3 at) {
#if EXCLUSIONS == 1
    vec3 in_box = place_in_box(0, at);
    return is_in_box(in_box) && is_in_interior(0, in_box);
#else
    int first = -1, second = -1;
    for (int hull = 0; hull < EXCLUSIONS; ++hull) {
        bool is_near = is_in_box(place_in_box(hull, at));
        if (is_near && first >= 0 && second < 0) second = hull;
        if (is_near && first < 0) first = hull;
    }
    return first >= 0 && is_in_interior(first, place_in_box(first, at)) ||
           second >= 0 && is_in_interior(second, place_in_box(second, at));
#endif
}
