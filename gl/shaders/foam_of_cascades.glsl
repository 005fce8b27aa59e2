// Foam at a point is the maximum over the cascades (Cascade::foam_r8). For means over many
// whitecaps the maximum is too small: cascades are independent, so if they cover the fractions a
// and b, 1 - (1 - a)(1 - b) is covered.
struct FoamOfCascades {
    float cover;   // covered fraction
    float mean;   // 0: value at a point; 1: mean over whitecaps of any age and the water between
    float thick;  // thickness of breaking foam: 1 for plunging waves, less for small spilling ones
};

const FoamOfCascades no_foam = FoamOfCascades(0.0, 0.0, 1.0);

// Combines foam with foam of another source. Whitecaps are a few texels wide, so the fourth mip
// hardly resolves any.
FoamOfCascades with_foam_of(FoamOfCascades all, float cover, float mip, float thick) {
    float mean = smoothstep(1.0, 4.0, mip);
    float both = all.cover * cover, sum = max(all.cover + cover, 1e-4);
    return FoamOfCascades(mix(max(all.cover, cover), all.cover + cover - both, mean), (all.cover * all.mean + cover * mean) / sum,
                       mix(all.thick, thick, mix(smoothstep(0.5, 0.9, cover / sum), cover / sum, mean)));
}

FoamOfCascades with_cascade(FoamOfCascades all, int cascade, float cover, float mip) {
    // A cascade with texels of 2 m holds waves of 6 m and longer.
    return with_foam_of(all, cover, mip, clamp(0.5 / cascade_scale[cascade].x, 0.3, 1.0));
}
