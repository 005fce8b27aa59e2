// How much of a place is under foam: what the tiles' maps say, and nothing else. Texels rest, so foam stays on its water.
uniform mediump sampler2DArray foam_maps;  // a part of 1, a layer a tile

float part_of_tile(int tile) {
#ifdef SHORE
    return shore.parts[tile];
#else
    return 1.0;
#endif
}

#if FOAM_OF_VERTICES > 0
// That of the coarsest tiles, which is wider than the mesh is fine.
FoamOfTiles foam_by_vertices() {
#ifdef SKIRT
    FoamOfTiles all = no_foam;
    for (int tile = 0; tile < FOAM_OF_VERTICES; ++tile)
        all = with_tile(all, tile, tile_slope[tile].w * part_of_tile(tile), 4.0);
    return all;
#else
    // Smoothed edges ask for pixels whose middle is beside its triangles.
    vec3 foam = clamp(foam_of_vertices, 0.0, 1.0);
    return FoamOfTiles(foam.x, foam.y, foam.z);
#endif
}
#endif

// One tile's, of a piece so wide around a place.
float foam_of_tile(int tile, vec2 at, float distance_m, float mip) {
    vec2 uv = place_in_tile(tile, at);
#if SHADING == HIGH && TILES == 1
    // As its waves: mixed by weights that add to one, so that the mean stays.
    Copies copies = copies_at(tile, at, distance_m);
    if (!copies.are_one)
        return dot(copies.weights * copies.weights, vec2(textureLod(foam_maps, vec3(uv + copies.first, tile), mip).x,
                                                         textureLod(foam_maps, vec3(uv + copies.second, tile), mip).x));
#endif
    return textureLod(foam_maps, vec3(uv, tile), mip).x;
}

#ifdef SHORE
// Foam of waves that break on the shore is thick, and hides what the tiles have there. A texel of it is metres wide, and all of it breaks at
// once: without bent edges one would see squares.
FoamOfTiles with_foam_of_shore(FoamOfTiles all, vec2 ragged) {
#if SHADING == HEADSET
    float foam = shore.water.w;
#else
    float foam = shore_water_at(shore.at + ragged * (1.5 / shore_size.z), shore.mip).w;
#endif
    float most = max(all.part, foam);
    float ours = smoothstep(0.3, 0.7, foam / max(all.part + foam, 1e-4));
    return FoamOfTiles(most, mix(all.mean, smoothstep(1.0, 4.0, shore.mip), ours), mix(all.thick, 1.0, ours));
}
#endif

// `ragged`, within [-1, 1], bends the edges of texels. Tiles of which no wave is left in the pixel have their mean.
FoamOfTiles foam_of_maps(vec2 at, vec2 ragged, float distance_m, Footprint pixel) {
#if FOAM_OF_VERTICES > 0
    FoamOfTiles all = foam_by_vertices();
#else
    FoamOfTiles all = no_foam;
#endif
    for (int tile = FOAM_OF_VERTICES; tile < TILES; ++tile) {
        // Lace is the shape of what is smaller than half a metre.
        float texels_a_m = tile_scale[tile].x, mip = log2(max(max(pixel.wide_m, 0.5) * texels_a_m, 1e-3));
        float part = tile_slope[tile].w, weight = float(tile) < foam_kind.x ? weight_of_tile(tile, mip) : 0.0;
        if (weight > 0.0) part = mix(part, foam_of_tile(tile, at + ragged / texels_a_m, distance_m, mip), weight);
        all = with_tile(all, tile, part * part_of_tile(tile), mip);
    }
#ifdef SHORE
    all = with_foam_of_shore(all, ragged);
#endif
    return all;
}
