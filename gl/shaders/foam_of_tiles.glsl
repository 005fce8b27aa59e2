// Foam at a place is the largest of the tiles' there (Tile::foam_r8). Of means over many whitecaps that would be too little: tiles know
// nothing of one another, so where one has foam on the part a of a place and one on b, 1 - (1 - a)(1 - b) is under foam.
struct FoamOfTiles {
    float part;  // of the place
    float mean;  // 0: what lies at one place; 1: a mean over whitecaps of any age, and over the water between them
};

// A whitecap is some texels wide: the fourth mip has hardly any of them left.
FoamOfTiles with_tile(FoamOfTiles all, float part, float mip) {
    float mean = smoothstep(1.0, 4.0, mip);
    float both = all.part * part;
    return FoamOfTiles(mix(max(all.part, part), all.part + part - both, mean),
                       (all.part * all.mean + part * mean) / max(all.part + part, 1e-4));
}
