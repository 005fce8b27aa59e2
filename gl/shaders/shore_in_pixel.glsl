// What a pixel of water knows of the shore that it is drawn at.
struct ShoreInPixel {
    vec4 parts;  // of the cascades
    vec4 water;  // as shore_water has it
    float mip;
    vec2 at;     // where the pixel is drawn
};

// Of the pixel that is drawn: main() looks first.
ShoreInPixel shore = ShoreInPixel(vec4(1.0), vec4(0.0), 0.0, vec2(0.0));

void look_at_shore(vec2 at) {
    float wide_m = footprint_of(at).wide_m;
    float mip = shore_mip(wide_m);
    shore = ShoreInPixel(parts_of_cascades(at), shore_water_at(at, mip), mip, at);
}

Slopes held_back(Slopes slopes, float part) {
    return Slopes(part * slopes.h, part * slopes.d, part * part * slopes.variance);
}
