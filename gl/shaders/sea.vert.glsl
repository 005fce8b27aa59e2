// Patch of the quadtree: reference positions from integers, displacement from the texture, morph
// between levels. The computation must equal that of quadtree/patch_vertex.hpp.
#ifdef MULTIVIEW
#extension GL_OVR_multiview2 : require
layout(num_views = 2) in;
#endif
precision highp float;
precision highp int;
#include "scene.glsl"

layout(location = 0) in uvec2 vertex;   // i, j: 0 to V
layout(location = 1) in uvec2 corner;   // steps from the grid's corner to the patch's
layout(location = 2) in uvec2 level;    // x: level; y: parity of the diagonals
layout(location = 3) in float inner_weight;
layout(location = 4) in vec4 edge_weights;  // +x, +z, -x, -z

uniform highp sampler2DArray displacement;  // Dx, height, Dz; one layer per cascade
#if VERTEX_CASCADES > 0
uniform highp sampler2DArray slopes;  // the texture of waves.glsl
out vec4 coarsest;                    // h_x, h_z, D_xx, D_zz of the coarsest cascade
#elif SURFACE == OPEN
uniform highp sampler2DArray slopes;
out vec2 long_slopes;  // slopes of the coarsest cascade's waves of at least 12 m
#if MESH_SLOPES
out vec2 mesh_slopes;  // slopes of the height of the waves that the mesh resolves
#endif
#endif

out vec4 place;  // relative to the viewer; w is 1 (0 at the horizon of the skirt)
out vec2 rest;   // undisplaced position
out float sunlit_vertex;
flat out int patch_level;

invariant gl_Position;

#if SURFACE != OPEN
#include "small_water.glsl"
#endif
#ifdef SHORE
#include "shore.glsl"

// Returns the cascades' weights at the displaced position, which itself depends on the weights. The
// weights change over lengths much larger than the displacement, and each iteration reduces the
// error by the ratio of the two. The first iteration starts at the undisplaced position.
vec4 shore_weights_where_drawn(vec2 at, vec2 displacements[CASCADES]) {
    vec4 at_shore = weights_of_cascades(at);
    for (int round = 0; round < 2; ++round) {
        vec2 drawn = at;
        for (int cascade = 0; cascade < CASCADES; ++cascade) drawn += at_shore[cascade] * displacements[cascade];
        at_shore = weights_of_cascades(drawn);
    }
    return at_shore;
}
#endif

#ifdef DYNAMIC_WAVES
#include "dynamic_waves.glsl"
#endif
#include "clouds.glsl"

// Displacement of a vertex, and the slopes of dynamic waves.
struct Moved {
    vec3 displacement;
    vec2 slopes;
};

// Returns the sum of the cascades at a vertex. Mips and weights depend on the reference position
// alone, so they are equal in all patches that share the vertex. The mip follows the vertex
// spacing, which grows with distance. It is half a level finer, because waves of a few vertices are
// still visible.
Moved displaced(ivec2 index) {
    vec2 at = grid.xy + vec2(index) * grid.z;
    vec2 from_centre = abs(at - fade.xy);
    float fade_weight = clamp((fade.z - max(from_centre.x, from_centre.y)) * fade.w, 0.0, 1.0);
    float spacing = max(mesh.y, length(vec3(at.x, viewer.z, at.y)) * mesh.x);
    vec3 moved = vec3(0.0);
#if SURFACE != OPEN
    moved.y = small_height(at, spacing);
#else
    float mips[CASCADES], weights[CASCADES];
    vec4 texels[CASCADES];
    for (int cascade = 0; cascade < CASCADES; ++cascade) {
        mips[cascade] = max(log2(spacing * cascade_scale[cascade].x) - 0.5, 0.0);
        weights[cascade] = weight_of_cascade(cascade, mips[cascade]);
        texels[cascade] = vec4(0.0);
        if (weights[cascade] > 0.0)
            texels[cascade] = textureLod(displacement, vec3(place_in_cascade(cascade, at), cascade), min(mips[cascade], mesh.z));
    }
#ifdef SHORE
    vec2 displacements[CASCADES];
    for (int cascade = 0; cascade < CASCADES; ++cascade) displacements[cascade] = fade_weight * weights[cascade] * texels[cascade].xz;
    vec4 at_shore = shore_weights_where_drawn(at, displacements);
#else
    const vec4 at_shore = vec4(1.0);
#endif
    for (int cascade = 0; cascade < CASCADES; ++cascade) {
        moved += at_shore[cascade] * weights[cascade] * texels[cascade].xyz;
    }
#ifdef SHORE
    moved.y += shore_height_at(at + fade_weight * moved.xz, shore_mip(spacing));
#endif
#endif
    moved *= fade_weight;
    vec2 slopes = vec2(0.0);
#ifdef DYNAMIC_WAVES
    // Half a level finer, like the mips of the cascades.
    vec4 dynamic = fade_weight * dynamic_waves(at + moved.xz, spacing * 0.7071068);
    moved.y += dynamic.x;
    slopes = dynamic.yz;
#endif
    return Moved(moved, slopes);
}

Moved mixed(Moved a, Moved b, float weight) {
    return Moved(mix(a.displacement, b.displacement, weight), mix(a.slopes, b.slopes, weight));
}

#if BELOW
// Blends the mesh to the plane in `lens` around a lens near the water. Between vertices the mesh
// differs from the surface that queries return, so without the blend its edge would not coincide
// with the waterline in the image.
vec3 as_at_lens(vec3 at) {
    if (lens.w <= 0.0) return at;
    vec3 from_eye = at - eye[EYE].xyz;
    float near = 1.0 - smoothstep(0.4, 1.2, abs(eye[EYE].y - lens.x - dot(lens.yz, eye[EYE].xz)));
    float inner = 0.3 + 2.0 * mesh.y;
    float weight = near * (1.0 - smoothstep(inner, 3.0 * inner, length(from_eye.xz)));
    return vec3(at.x, mix(at.y, lens.x + dot(lens.yz, at.xz), weight), at.z);
}
#endif

void main() {
    int last = int(grid.w);
    ivec2 ij = ivec2(vertex);
    int stride = 1 << (int(skirt.w) - int(level.x));
    ivec2 index = ivec2(corner) + ij * stride;
    Moved moved = displaced(index);

    ivec2 odd = ij & 1;
    if (odd != ivec2(0)) {
        float weight = inner_weight;
        if (ij.x == 0) weight = edge_weights.z;
        if (ij.x == last) weight = edge_weights.x;
        if (ij.y == 0) weight = edge_weights.w;
        if (ij.y == last) weight = edge_weights.y;
        ivec2 offset = odd;
        if (odd == ivec2(1) && ((ij.x / 2 + ij.y / 2 + int(level.y)) & 1) != 0) offset.y = -1;
        offset *= stride;
        if (weight < 1.0) moved = mixed(mixed(displaced(index - offset), displaced(index + offset), 0.5), moved, weight);
    }
    rest = grid.xy + vec2(index) * grid.z;
#if VERTEX_CASCADES > 0
    float spacing = max(mesh.y, length(vec3(rest.x, viewer.z, rest.y)) * mesh.x);
    float mip = max(log2(spacing * cascade_scale[0].x), 0.0);
    vec4 texel = textureLod(slopes, vec3(place_in_cascade(0, rest), 0.0), mip) * (255.0 / 127.0) - 128.0 / 127.0;
    coarsest = texel * (cascade_slope[0].x * weight_of_cascade(0, mip));
#endif
#if VERTEX_CASCADES == 0 && SURFACE == OPEN
    // The mip of texels of 4 m, which resolves waves of three texels.
    float long_mip = max(log2(max(4.0, max(mesh.y, length(vec3(rest.x, viewer.z, rest.y)) * mesh.x)) * cascade_scale[0].x), 0.0);
    vec2 long_texel = textureLod(slopes, vec3(place_in_cascade(0, rest), 0.0), long_mip).xy * (255.0 / 127.0) - 128.0 / 127.0;
    long_slopes = long_texel * (cascade_slope[0].x * weight_of_cascade(0, long_mip));
#endif
#if MESH_SLOPES
    float spacing = max(mesh.y, length(vec3(rest.x, viewer.z, rest.y)) * mesh.x);
    mesh_slopes = moved.slopes;
    vec4 at_shore = vec4(1.0);
#ifdef SHORE
    vec2 drawn = rest + moved.displacement.xz;
    at_shore = weights_of_cascades(drawn);
    mesh_slopes += shore_water_at(drawn, shore_mip(spacing)).yz;
#endif
    for (int cascade = 0; cascade < CASCADES; ++cascade) {
        float mip = max(log2(spacing * cascade_scale[cascade].x), 0.0);
        vec2 texel = textureLod(slopes, vec3(place_in_cascade(cascade, rest), cascade), mip).xy * (255.0 / 127.0) - 128.0 / 127.0;
        mesh_slopes += texel * (at_shore[cascade] * cascade_slope[cascade].x * weight_of_cascade(cascade, mip));
    }
#endif
    vec3 at = vec3(rest.x + moved.displacement.x, moved.displacement.y - viewer.z, rest.y + moved.displacement.z);
#if BELOW
    at = as_at_lens(at);
#endif
    place = vec4(at, 1.0);
    sunlit_vertex = sunlit_at(at.xz, 0.0);
    patch_level = int(level.x);
    gl_Position = clip_from_viewer[EYE] * place;
}
