// Uniform block that all shaders of the sea share. The layout is that of gl/water/scene_block.hpp.
//
// Lengths are metres, and y is up. Positions are relative to the viewer, which lies between the
// eyes. Floats resolve millimetres near the viewer but not far from the world's origin.
//
// The sea is a sum of CASCADES wave cascades, the coarsest first. Each is periodic, may be rotated,
// and is a layer of the textures.

// SHADING is the tier of cost per pixel: a headset draws nine million pixels, 72 times a second.
#define HEADSET 0
#define MEDIUM 1
#define HIGH 2
// The coarsest of four cascades is shaded from its vertices there.
#if SHADING == HEADSET && CASCADES == 4
#define VERTEX_CASCADES 1
#else
#define VERTEX_CASCADES 0
#endif
// Values of SURFACE: gl::Surface.
#define OPEN 0
#define LAKE 1
#define COAST 2
#define RIVER 3
#define POND 4
// Number of coarsest cascades whose compression makes foam.
#if CASCADES > 3
#define FOAM_CASCADES 3
#else
#define FOAM_CASCADES CASCADES
#endif
// Vertices output the slopes of the mesh, because slopes of triangles are discontinuous, and folds
// contain slivers.
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
    // xyz: vector from the viewer to the eye
    highp vec4 eye[2];
    // xy: the viewer's texture coordinates; zw: cosine and sine of the cascade's rotation, divided
    // by its side
    highp vec4 cascade_place[4];
    // x: texels per metre; y: the mip that resolves no wave of the cascade; z: side
    highp vec4 cascade_scale[4];
    // x, y: scale of slopes and of variances; z: slope variance of all waves, summed over both
    // axes
    highp vec4 cascade_slope[4];
    // xy: the viewer's position in the noise that varies the copies of the cascade, and in the sines
    // that displace it; z: side of the cascade over their period
    highp vec4 cascade_noise[4];
    // x: 1 if the sky is drawn where the lens is in the air; y: extinction of spindrift, 1/m; z:
    // height above the still-water level; w: height of that level in the world
    highp vec4 viewer;
    // xy: corner of the grid; z: metres per step; w: V
    highp vec4 grid;
    // xy: centre of the fade; z: its end; w: 1 / (fade end - fade start)
    highp vec4 fade;
    // x: vertex spacing per metre of distance; y: minimum spacing; z: last mip of the displacement
    highp vec4 mesh;
    // xy: centre of the grid; z: steps along S; w: deepest level
    highp vec4 skirt;
    // xyz: direction towards the sun, or the moon at night; w: angular radius of its disc, radians
    highp vec4 sun;
    // xyz: irradiance perpendicular to the rays; w: exposure
    highp vec4 sun_irradiance;
    // xyz: irradiance on a level plane; w: last level of the sky
    highp vec4 sky_irradiance;
    // xyz: extinction, 1/m; w: distance at which the softening of the horizon reaches 63 %
    highp vec4 haze;
    // xyz: absorption, 1/m; w: depth of the sea
    highp vec4 water_absorption;
    // xyz: backscattering, 1/m; w: mean square slope of the detail
    highp vec4 water_backscattering;
    // xyz: direction of sunlight that has entered the back of a wave; w: path per
    // metre below the crest, negative
    highp vec4 crest_ray;
    // xyz: sunlight and skylight through crests, with all factors of through_crests() that are
    // uniform
    highp vec4 crest_sun, crest_sky;
    // x: significant wave height; y: alpha of the unresolved (subgrid) waves; zw: wind direction
    highp vec4 waves;
    // xy: cosine and sine of a layer's rotation, divided by its period; zw: cosine and sine
    highp vec4 detail_turn[2];
    // texture coordinates of the viewer: xy of layer 0, zw of layer 1
    highp vec4 detail_shift;
    // the viewer's position in the noise, whose period is ripple_noise_tiles layer periods
    highp vec4 detail_noise;
    // 1/m; xy: foam's bubbles and lace; zw: the two scales of gusts
    highp vec4 noise_scale;
    // the viewer's position in bubbles and lace, which drift
    highp vec4 foam_shift;
    // the viewer's position in the two scales of gusts
    highp vec4 gust_shift;
    // water surface around the lens, relative to the viewer: y = lens.x + dot(lens.yz, xz); w:
    // distance from the eye to the near plane, 0 if the whole lens is in the air
    highp vec4 lens;
    // xy: the viewer's texture coordinates; zw: their change per metre, 0 for an even floor
    highp vec4 floor_place;
    // xy: metres along x and z; zw: corner relative to the viewer
    highp vec4 floor_size;
    // xy: cells along x and z; zw: the viewer's position in a square of 64 m
    highp vec4 floor_mesh;
    // x: height of an even floor; y: height up to which sand is wet, metres above the still-water
    // level; z: radians per pixel; w: 1 for sand, 0 for a uniform albedo
    highp vec4 floor_look;
    // w: 1 if the floor may be visible from above
    highp vec4 floor_albedo;
    // like cascade_place, for the caustics' texture; zw: 0 without caustics
    highp vec4 caustic_place;
    // xy: the viewer's position in the noise that selects copies of the caustics; z: side of the
    // caustics over that of the noise
    highp vec4 caustic_copies;
    // xy: radians per metre; z: phase at the viewer; w of the first row: focal depth
    highp vec4 caustic_row[3];
    // xy: drift of the snapshots, texture coordinates; z: compression of a slope of 1, in standard
    // deviations; w: 1 if the cascade has snapshots
    highp vec4 foam_cascade[3];
    // foam that has decayed since each snapshot; 1 and more: no effect
    highp vec4 foam_age[4];
    // x: standard deviation of what a square leaves out; yzw: a, b, c (sim/snapshot_foam.hpp)
    highp vec4 foam_filter[12];
    // near and far streaks, along and across the wind; xy: 1/m; zw: the viewer's position; they
    // drift
    highp vec4 foam_streaks[2];
    // x: compression at which half of the water is white; y: softness with which streaks
    // gather old foam; z: cover of films in a gale; w: weight of far windrows
    highp vec4 foam_kind;
    // xy: factors of the slopes along x and z in the compression
    highp vec4 foam_front;
    // octaves of small water; xy: cosine and sine of the rotation; z: cells per metre; w: height
    highp vec4 bump_grid[8];
    // the viewer's position in an octave; xy: within the cell; zw: index of the cell
    highp vec4 bump_place[8];
    // rotation of the gradients, turns
    highp vec4 bump_turn[2];
    // x: wavelength over length of crests, at most 1; y: foam on a coast's crests, or for a pond
    // the drag of waves over their height; zw: warp of a coast's ridges, metres per metre of height
    highp vec4 bump_kind;
    // xy: wave vector, rad/m; z: height; w: phase at the viewer
    highp vec4 pond_wave[24];
    // xy: the viewer's position in the flow map of a river; z: 1 / side
    highp vec4 flow_place;
    // xy: phases of the two advected copies in their cycles; z: distance that the fastest water
    // covers in a cycle, m
    highp vec4 flow_cycle;
    // offsets of the two copies, m
    highp vec4 flow_jump;
    // x: 1 if the shader encodes sRGB, 0 if the framebuffer does; y: 1 if radiance is written; z:
    // exposure by which samples of radiance are weighted, or 0; w: luminance of a radiance of 1,
    // cd/m^2; stored luminance is linear
    highp vec4 output_kind;
    // xyz: direction towards the sun, which lights the moon; w: lit fraction of the moon's disc, 0
    // if the light in `sun` is the sun
    highp vec4 moon;
    // x: irradiance of a star of magnitude 0; 0 by day
    highp vec4 stars;
    // xy: the viewer's texture coordinates; zw: their change per metre
    highp vec4 shore_place;
    // xy: texels along x and z; z: texels per metre; w: last mip of the shore's waves
    highp vec4 shore_size;
    // xy: the viewer's texture coordinates; z: their change per metre; w: texels per metre
    highp vec4 dynamic_waves_place;
    // xy: centre relative to the viewer; z: half the side that is drawn
    highp vec4 dynamic_waves_extent;
    // the viewer's position in the grid of glints; xy: metres within a square of 64 m; zw: index of
    // the square
    highp vec4 glint_place;
    // xy: the viewer's position in the clouds' shadows; z: 1 / period; w: 1 if there are shadows
    highp vec4 cloud_place;
    // x: mean sunlight on the sea over sun_irradiance; y: 1 / transmittance of the clouds for
    // sun_irradiance, 0 if they do not hide the sun; z: sunlight at the viewer over sun_irradiance
    highp vec4 cloud_light;
#ifdef EXCLUSIONS
    // axes of the boxes around the interiors of hulls: a position (x, y, z, 1) times the three of a
    // hull is in [0, 1] inside
    highp vec4 exclusion_box[24];
    // xy: cells along x and z of the hull; z: layer of exclusion_maps
    highp vec4 exclusion_map[8];
#endif
};

// Fraction of sun_irradiance that the clouds let through, which main() sets.
float sunlit = 1.0;

// Returns the irradiance perpendicular to the sun's rays.
vec3 sunlight() { return sunlit * sun_irradiance.rgb; }

const float ripple_noise_tiles = 13.0;

// Converts a world-space vector in metres to a difference of texture coordinates of a cascade.
vec2 rotated_into_cascade(int cascade, vec2 vector) {
    vec2 turn = cascade_place[cascade].zw;
    return vec2(turn.x * vector.x + turn.y * vector.y, turn.x * vector.y - turn.y * vector.x);
}

// Returns a cascade's texture coordinates of a position relative to the viewer.
vec2 place_in_cascade(int cascade, vec2 at) { return cascade_place[cascade].xy + rotated_into_cascade(cascade, at); }

// Returns the weight of a cascade that is sampled at a mip. The weight falls from 1 to 0 over the
// last level before the mip that resolves no wave. Cascades of weight 0 are not sampled.
float weight_of_cascade(int cascade, float mip) { return clamp(cascade_scale[cascade].y - mip, 0.0, 1.0); }
