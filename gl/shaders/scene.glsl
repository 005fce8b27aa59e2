// What every shader of the sea knows about the frame. Lengths are metres; positions are relative to the viewer, who
// stands between the eyes: far from the world's origin a float has no millimetres left, near the viewer it has. y is up.
// Laid out as gl/scene_block.hpp.

#ifdef MULTIVIEW
#define EYE int(gl_ViewID_OVR)
#else
uniform int eye_index;
#define EYE eye_index
#endif

layout(std140) uniform Scene {
    highp mat4 clip_from_viewer[2];
    highp mat4 viewer_from_clip[2];
    highp vec4 eye[2];            // xyz: from the viewer to the eye
    highp vec4 viewer;            // xy: texture coordinates of the viewer's place; z: height above rest; w: 1 / L
    highp vec4 grid;              // xy: the grid's corner; z: metres a step; w: V
    highp vec4 fade;              // xy: fade centre; z: fade end; w: 1 / (fade end - fade start)
    highp vec4 mesh;              // x: spacing of vertices for each metre of distance; y: finest spacing; z: last mip
                                  // of the displacement; w: texels a metre
    highp vec4 skirt;             // xy: the grid's middle; z: steps along S; w: deepest level
    highp vec4 sun;               // xyz: towards the sun; w: radius of its disc, radians
    highp vec4 sun_irradiance;    // across the rays; w: exposure
    highp vec4 sky_irradiance;    // on a level plane; w: last level of the sky
    highp vec4 haze;              // extinction, 1/m; w: distance at which the horizon's softening has taken 63 %
    highp vec4 water_absorption;  // 1/m; w: depth of the sea
    highp vec4 water_scattering;  // backwards, 1/m; w: mean square slope of the detail
    highp vec4 waves;             // x: significant height; y: alpha of the water between texels; zw: the wind's direction
    highp vec4 detail_turn[2];    // rows of a rotation over the tile's side
    highp vec4 detail_shift;      // xy of layer 0, zw of layer 1: where the viewer is in the tile
    highp vec4 second_shift;      // xy: where the viewer is in the second copy of the waves
    highp vec4 noise_scale;       // xy: of foam's two layers, zw: of the gusts' two, 1/m
    highp vec4 foam_shift;        // where the viewer is in them
    highp vec4 gust_shift;
    highp vec4 output_kind;       // x: 1 if the shader encodes sRGB, 0 if the framebuffer does;
                                  // y: the Jacobian below which foam begins
};
