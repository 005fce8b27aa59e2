// How much of a place is under foam: what the cascades' maps say, and nothing else. Texels rest, so foam stays on its water.
uniform mediump sampler2DArray foam_maps;  // a part of 1, a layer a cascade

float part_of_cascade(int cascade) {
#ifdef SHORE
    return shore.parts[cascade];
#else
    return 1.0;
#endif
}

#if FOAM_OF_VERTICES > 0
// That of the coarsest cascades, which is wider than the mesh is fine.
FoamOfCascades foam_by_vertices() {
#ifdef SKIRT
    FoamOfCascades all = no_foam;
    for (int cascade = 0; cascade < FOAM_OF_VERTICES; ++cascade)
        all = with_cascade(all, cascade, cascade_slope[cascade].w * part_of_cascade(cascade), 4.0);
    return all;
#else
    // Smoothed edges ask for pixels whose middle is beside its triangles.
    vec3 foam = clamp(foam_of_vertices, 0.0, 1.0);
    return FoamOfCascades(foam.x, foam.y, foam.z);
#endif
}
#endif

// One cascade's, of a piece so wide around a place.
float foam_of_cascade(int cascade, vec2 at, float distance_m, float mip) {
    vec2 uv = place_in_cascade(cascade, at);
#if SHADING == HIGH && CASCADES == 1
    // As its waves: mixed by weights that add to one, so that the mean stays.
    Copies copies = copies_at(cascade, at, distance_m);
    if (!copies.are_one)
        return dot(copies.weights * copies.weights, vec2(textureLod(foam_maps, vec3(uv + copies.first, cascade), mip).x,
                                                         textureLod(foam_maps, vec3(uv + copies.second, cascade), mip).x));
#endif
    return textureLod(foam_maps, vec3(uv, cascade), mip).x;
}

#ifdef SHORE
// Foam of waves that break on the shore is thick, and hides what the cascades have there. A texel of it is metres wide, and all of it breaks at
// once: without bent edges one would see squares.
FoamOfCascades with_foam_of_shore(FoamOfCascades all, vec2 ragged) {
#if SHADING == HEADSET
    float foam = shore.water.w;
#else
    float foam = shore_water_at(shore.at + ragged * (1.5 / shore_size.z), shore.mip).w;
#endif
    float most = max(all.part, foam);
    float ours = smoothstep(0.3, 0.7, foam / max(all.part + foam, 1e-4));
    return FoamOfCascades(most, mix(all.mean, smoothstep(1.0, 4.0, shore.mip), ours), mix(all.thick, 1.0, ours));
}
#endif

// `ragged`, within [-1, 1], bends the edges of texels. Cascades of which no wave is left in the pixel have their mean.
FoamOfCascades foam_of_maps(vec2 at, vec2 ragged, float distance_m, Footprint pixel) {
#if FOAM_OF_VERTICES > 0
    FoamOfCascades all = foam_by_vertices();
#else
    FoamOfCascades all = no_foam;
#endif
    for (int cascade = FOAM_OF_VERTICES; cascade < CASCADES; ++cascade) {
        // Lace is the shape of what is smaller than half a metre.
        float texels_a_m = cascade_scale[cascade].x, mip = log2(max(max(pixel.wide_m, 0.5) * texels_a_m, 1e-3));
        float part = cascade_slope[cascade].w, weight = float(cascade) < foam_kind.x ? weight_of_cascade(cascade, mip) : 0.0;
        if (weight > 0.0) part = mix(part, foam_of_cascade(cascade, at + ragged / texels_a_m, distance_m, mip), weight);
        all = with_cascade(all, cascade, part * part_of_cascade(cascade), mip);
    }
#ifdef SHORE
    all = with_foam_of_shore(all, ragged);
#endif
    return all;
}
