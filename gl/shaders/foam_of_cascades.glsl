// Foam at a place is the largest of the cascades' there (Cascade::foam_r8). Of means over many whitecaps that would be too little: cascades know
// nothing of one another, so where one has foam on the part a of a place and one on b, 1 - (1 - a)(1 - b) is under foam.
struct FoamOfCascades {
    float part;   // of the place
    float mean;   // 0: what lies at one place; 1: a mean over whitecaps of any age, and over the water between them
    float thick;  // that which breaks: 1 of waves that plunge, less of small ones, which only spill
};

const FoamOfCascades no_foam = FoamOfCascades(0.0, 0.0, 1.0);

// A whitecap is some texels wide: the fourth mip has hardly any of them left.
FoamOfCascades with_foam_of(FoamOfCascades all, float part, float mip, float thick) {
    float mean = smoothstep(1.0, 4.0, mip);
    float both = all.part * part, sum = max(all.part + part, 1e-4);
    return FoamOfCascades(mix(max(all.part, part), all.part + part - both, mean), (all.part * all.mean + part * mean) / sum,
                       mix(all.thick, thick, mix(smoothstep(0.5, 0.9, part / sum), part / sum, mean)));
}

FoamOfCascades with_cascade(FoamOfCascades all, int cascade, float part, float mip) {
    // Texels of 2 m belong to waves of 6 m and more.
    return with_foam_of(all, part, mip, clamp(0.5 / cascade_scale[cascade].x, 0.3, 1.0));
}
