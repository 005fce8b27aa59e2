// Values of the shore at a pixel of water.
struct ShoreInPixel {
    vec4 weights;  // weights of the cascades
    vec4 water;  // channels of shore_water
    float mip;
    vec2 at;     // displaced position
};

// Shore at the current pixel. main() sets it by sample_shore() before it calls other functions.
ShoreInPixel shore = ShoreInPixel(vec4(1.0), vec4(0.0), 0.0, vec2(0.0));

void sample_shore(vec2 at) {
    float wide_m = footprint_of(at).wide_m;
    float mip = shore_mip(wide_m);
    shore = ShoreInPixel(weights_of_cascades(at), shore_water_at(at, mip), mip, at);
}

Slopes held_back(Slopes slopes, float weight) {
    return Slopes(weight * slopes.h, weight * slopes.d, weight * weight * slopes.variance);
}
