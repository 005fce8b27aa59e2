// Laid out as RockLight of gl/rock.cpp.
layout(std140) uniform RockLight {
    highp mat4 clip_from_rock;
    highp vec4 sun;             // xyz: towards it
    highp vec4 sun_irradiance;  // across the rays; w: exposure by which samples are weighted, or 0
    highp vec4 sky_irradiance;  // on a level plane
};
