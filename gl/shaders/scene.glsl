// What every shader of the sea knows about the frame. Lengths are metres; positions are relative to the viewer, who
// stands between the eyes: far from the world's origin a float has no millimetres left, near the viewer it has. y is up.
// Laid out as gl/water/scene_block.hpp.
//
// The sea is a sum of CASCADES square cascades of waves, the coarsest first; each repeats, each may be rotated, and each is a layer
// of the textures.

// SHADING is how much a pixel may cost: a headset draws nine million of them, 72 times a second.
#define HEADSET 0
#define MEDIUM 1
#define HIGH 2
// The coarsest of four cascades is shaded from its vertices there.
#if SHADING == HEADSET && CASCADES == 4
#define VERTEX_CASCADES 1
#else
#define VERTEX_CASCADES 0
#endif
// What is drawn: gl::Surface.
#define OPEN 0
#define LAKE 1
#define COAST 2
#define RIVER 3
#define POND 4
// So many of the coarsest cascades bring their foam with the mesh's vertices; pixels look it up of the others.
#if SURFACE != OPEN || SHADING == HIGH
#define FOAM_OF_VERTICES 0
#elif SHADING == MEDIUM
#define FOAM_OF_VERTICES (CASCADES / 2)
#else
#define FOAM_OF_VERTICES CASCADES
#endif
// Vertices hand out the slopes of the mesh: those of its triangles jump, and where it folds some are slivers.
#define MESH_SLOPES (SHADING != HEADSET && SURFACE == OPEN)

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
    highp vec4 cascade_place[4];     // xy: texture coordinates of the viewer's place; zw: cosine and sine of its turn over its side
    highp vec4 cascade_scale[4];     // x: texels a metre; y: the mip at which nothing is left of its waves; z: side
    highp vec4 cascade_slope[4];     // x: what slopes count in; y: variances; z: variance of all its waves, of both axes;
                                  // w: mean part of the sea under its foam
    highp vec4 tile_noise[4];     // xy: the viewer's place in the noise that tells its copies apart; z: the cascade's side over the noise's
    highp vec4 viewer;            // x: 1 if the sky is drawn, where the lens is in the air; z: height above rest
    highp vec4 grid;              // xy: the grid's corner; z: metres a step; w: V
    highp vec4 fade;              // xy: fade centre; z: fade end; w: 1 / (fade end - fade start)
    highp vec4 mesh;              // x: spacing of vertices for each metre of distance; y: finest spacing; z: last mip
                                  // of the displacement
    highp vec4 skirt;             // xy: the grid's middle; z: steps along S; w: deepest level
    highp vec4 sun;               // xyz: towards the sun, or the moon at night; w: radius of its disc, radians
    highp vec4 sun_irradiance;    // across the rays; w: exposure
    highp vec4 sky_irradiance;    // on a level plane; w: last level of the sky
    highp vec4 haze;              // extinction, 1/m; w: distance at which the horizon's softening has taken 63 %
    highp vec4 water_absorption;  // 1/m; w: depth of the sea
    highp vec4 water_backscattering;  // 1/m; w: mean square slope of the detail
    highp vec4 water_scattering;  // in all directions, 1/m
    highp vec4 waves;             // x: significant height; y: alpha of the water between texels; zw: the wind's direction
    highp vec4 detail_turn[2];    // rows of a rotation over the cascade's side
    highp vec4 detail_shift;      // xy of layer 0, zw of layer 1: where the viewer is in the cascade
    highp vec4 detail_noise;      // the same in a square of ripple_noise_tiles such cascades, which repeats
    highp vec4 noise_scale;       // xy: of foam's bubbles and lace, zw: of the gusts' two, 1/m
    highp vec4 foam_shift;        // where the viewer is in foam's, which drift
    highp vec4 gust_shift;
    highp vec4 lens;              // the surface around the lens, relative to the viewer: y = lens.x + dot(lens.yz, xz); w: how
                                  // far ahead of the eye the near plane lies, 0 where all of the lens is in the air
    highp vec4 floor_place;       // xy: texture coordinates of the viewer's place; zw: the same a metre, 0 for a plane
    highp vec4 floor_size;        // xy: metres along x and z; zw: where its corner is, from the viewer
    highp vec4 floor_mesh;        // xy: cells along x and z; zw: where the viewer is in a square of 64 m
    highp vec4 floor_look;        // x: height of a plane; y: up to where sand is wet, metres above rest; z: radians a
                                  // pixel; w: 1 for sand, 0 for an even albedo
    highp vec4 floor_albedo;      // w: 1 if the floor may be seen from above
    highp vec4 caustic_place;     // as cascade_place, of the caustics' texture; zw: 0 if there is none
    highp vec4 caustic_row[3];    // xy: radians a metre; z: phase at the viewer; w of the first: depth of the focus
    highp vec4 foam_streaks[2];   // along and across the wind, near and far: xy 1/m, zw where the viewer is; they drift
    highp vec4 foam_kind;         // x: so many cascades, the coarsest, make foam; y: how softly streaks gather old foam; z: height of
                                  // fresh foam, m; w: how much of it far windrows gather
    highp vec4 bump_grid[8];   // of small water's octaves: xy cosine and sine of the turn; z: cells a metre; w: height
    highp vec4 bump_place[8];     // where the viewer is in it: xy in the cell, zw which cell
    highp vec4 bump_turn[2];      // how far gradients have turned, turns
    highp vec4 bump_kind;         // x: how much longer crests are than waves, as a factor below 1; y: coast: foam on crests, pond:
                                  // drag of its waves over their height; zw: warp of a coast's ridges, metres a metre of height
    highp vec4 pond_wave[24];     // xy: wave vector, rad/m; z: height; w: phase at the viewer
    highp vec4 flow_place;        // xy: where the viewer is in the map of a river's flow, z: 1 over its side
    highp vec4 flow_cycle;        // xy: how far the two copies of its bumps are in their cycles; z: the fastest water's way in one, m
    highp vec4 flow_jump;         // where the copies began, m
    highp vec4 output_kind;       // x: 1 if the shader encodes sRGB, 0 if the framebuffer does; y: 1 if radiance is asked for;
                                  // z: the exposure by which samples of radiance are weighted, or 0; w: luminance of a radiance
                                  // of 1, cd/m^2
    highp vec4 moon;              // xyz: towards the sun, which lights it; w: part of its disc that is lit, 0 where the sun is
                                  // the light that `sun` says
    highp vec4 stars;             // x: irradiance of a star of magnitude 0; 0 by day
    highp vec4 shore_place;       // xy: texture coordinates of the viewer's place; zw: the same a metre
    highp vec4 shore_size;        // xy: texels along x and z; z: texels a metre; w: last mip of its waves
    highp vec4 dynamic_waves_place;       // of dynamic waves: xy: texture coordinates of the viewer's place; z: the same a metre; w: texels a metre
    highp vec4 dynamic_waves_extent;      // xy: its middle; z: half its side
};

const float ripple_noise_tiles = 13.0;

// The texture coordinates of a way in the world, metres, in a cascade's textures.
vec2 way_in_cascade(int cascade, vec2 way) {
    vec2 turn = cascade_place[cascade].zw;
    return vec2(turn.x * way.x + turn.y * way.y, turn.x * way.y - turn.y * way.x);
}

// Of a place relative to the viewer.
vec2 place_in_cascade(int cascade, vec2 at) { return cascade_place[cascade].xy + way_in_cascade(cascade, at); }

// How much of a cascade counts where it is seen through that mip. At the last level before the one in which no wave is left it
// begins to leave; cascades that have left cost nothing.
float weight_of_cascade(int cascade, float mip) { return clamp(cascade_scale[cascade].y - mip, 0.0, 1.0); }
