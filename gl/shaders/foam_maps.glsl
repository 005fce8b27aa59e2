// Foam coverage from the cascades' maps. The maps are sampled at undisplaced positions, so foam
// moves with the water.
uniform mediump sampler2DArray foam_maps;  // coverage in [0, 1]; one layer per cascade

float shore_weight_of_cascade(int cascade) {
#ifdef SHORE
    return shore.weights[cascade];
#else
    return 1.0;
#endif
}

#if FOAM_OF_VERTICES > 0
// Returns the foam of the coarsest cascades. It is coarse enough for the mesh to resolve.
FoamOfCascades foam_by_vertices() {
#ifdef SKIRT
    FoamOfCascades all = no_foam;
    for (int cascade = 0; cascade < FOAM_OF_VERTICES; ++cascade)
        all = with_cascade(all, cascade, cascade_slope[cascade].w * shore_weight_of_cascade(cascade), 4.0);
    return all;
#else
    // With multisampling, pixels whose centre is outside the triangles extrapolate.
    vec3 foam = clamp(foam_of_vertices, 0.0, 1.0);
    return FoamOfCascades(foam.x, foam.y, foam.z);
#endif
}
#endif

// Returns the foam of one cascade at a mip.
float foam_of_cascade(int cascade, vec2 at, float distance_m, float mip) {
    vec2 uv = place_in_cascade(cascade, at);
#if SHADING == HIGH && CASCADES == 1
    // Copies are blended as for the waves, but with weights that add up to one, which preserves the
    // mean.
    Copies copies = copies_at(cascade, at, distance_m);
    if (!copies.are_one)
        return dot(copies.weights * copies.weights, vec2(textureLod(foam_maps, vec3(uv + copies.first, cascade), mip).x,
                                                         textureLod(foam_maps, vec3(uv + copies.second, cascade), mip).x));
#endif
    return textureLod(foam_maps, vec3(uv, cascade), mip).x;
}

#ifdef SHORE
// Adds foam of waves that break on the shore. It is thick and hides foam of the cascades. Its
// texels are metres wide, so `ragged` distorts their edges, which would otherwise show as squares.
FoamOfCascades with_foam_of_shore(FoamOfCascades all, vec2 ragged) {
#if SHADING == HEADSET
    float foam = shore.water.w;
#else
    float foam = shore_water_at(shore.at + ragged * (1.5 / shore_size.z), shore.mip).w;
#endif
    float most = max(all.cover, foam);
    float ours = smoothstep(0.3, 0.7, foam / max(all.cover + foam, 1e-4));
    return FoamOfCascades(most, mix(all.mean, smoothstep(1.0, 4.0, shore.mip), ours), mix(all.thick, 1.0, ours));
}
#endif

// Returns the foam of all cascades. `ragged` in [-1, 1] distorts the edges of texels. Cascades of
// which the pixel resolves no wave use their mean.
FoamOfCascades foam_of_maps(vec2 at, vec2 ragged, float distance_m, Footprint pixel) {
#if FOAM_OF_VERTICES > 0
    FoamOfCascades all = foam_by_vertices();
#else
    FoamOfCascades all = no_foam;
#endif
    for (int cascade = FOAM_OF_VERTICES; cascade < CASCADES; ++cascade) {
        // Lace gives the structure below half a metre.
        float texels_a_m = cascade_scale[cascade].x, mip = log2(max(max(pixel.wide_m, 0.5) * texels_a_m, 1e-3));
        float cover = cascade_slope[cascade].w, weight = float(cascade) < foam_kind.x ? weight_of_cascade(cascade, mip) : 0.0;
        if (weight > 0.0) cover = mix(cover, foam_of_cascade(cascade, at + ragged / texels_a_m, distance_m, mip), weight);
        all = with_cascade(all, cascade, cover * shore_weight_of_cascade(cascade), mip);
    }
#ifdef SHORE
    all = with_foam_of_shore(all, ragged);
#endif
    return all;
}
