// Values of the shore at a pixel of water.
struct ShoreInPixel {
    vec4 parts;  // weights of the cascades
    vec4 water;  // channels of shore_water
    float mip;
    vec2 at;     // displaced position
};

// Shore at the current pixel. main() sets it by look_at_shore() before it calls other functions.
ShoreInPixel shore = ShoreInPixel(vec4(1.0), vec4(0.0), 0.0, vec2(0.0));

void look_at_shore(vec2 at) {
    float wide_m = footprint_of(at).wide_m;
    float mip = shore_mip(wide_m);
    shore = ShoreInPixel(parts_of_cascades(at), shore_water_at(at, mip), mip, at);
}

Slopes held_back(Slopes slopes, float part) {
    return Slopes(part * slopes.h, part * slopes.d, part * part * slopes.variance);
}
