// Surface of a PelagicOcean, which sets the uniforms of the first group in each frame. Lengths are
// metres. Positions are relative to the camera that the frame is drawn for, so that floats are
// exact to a millimetre near it, anywhere in the world.
shader_type spatial;
render_mode skip_vertex_transform;

uniform sampler2DArray displacement; // Dx, height, Dz; one layer per cascade
uniform sampler2DArray slopes;       // h_x, h_z, D_xx, D_zz in signed bytes: 128 is zero
uniform sampler2DArray moments;      // D_xz, variances of h_x and h_z within the texel
uniform sampler2DArray snapshots;    // compression at past moments; layer i cascades + j: image i of cascade j
uniform int cascades = 0;
// xy: texture coordinates of the camera; zw: cosine and sine of the cascade's rotation / side
uniform vec4 cascade_place_0;
uniform vec4 cascade_place_1;
uniform vec4 cascade_place_2;
uniform vec4 cascade_place_3;
// x: texels per metre; y: range of slopes; z: range of variances; w: variance of all slopes
uniform vec4 cascade_scale_0;
uniform vec4 cascade_scale_1;
uniform vec4 cascade_scale_2;
uniform vec4 cascade_scale_3;
// xy: drift of the snapshots in texture coordinates; z: compression per slope, 0: makes no foam
uniform vec4 cascade_foam_0;
uniform vec4 cascade_foam_1;
uniform vec4 cascade_foam_2;
uniform vec4 cascade_foam_3;
uniform float foam_level = 1000.0;   // compression of half foam
uniform vec4 foam_front;             // xy: factors of the slopes along x and z in the compression
uniform vec4 snapshot_ages_0 = vec4(1.0); // foam that has decayed since each snapshot
uniform vec4 snapshot_ages_1 = vec4(1.0);
uniform vec4 snapshot_ages_2 = vec4(1.0);
uniform vec4 snapshot_ages_3 = vec4(1.0);
uniform sampler2D dynamic_waves_texels; // height, slopes along x and z, foam
// xy: texture coordinates of the camera; z: their change per metre; w: texels per metre
uniform vec4 dynamic_waves_place;
uniform vec4 dynamic_waves_extent;   // xy: centre; z: half the side that is drawn, 0: no waves
uniform sampler2D shore_weights;     // weights of the cascades
uniform sampler2D shore_water;       // height, slopes along x and z, foam
uniform vec4 shore_place;            // xy: texture coordinates of the camera; zw: change per metre
uniform vec4 shore_size;             // xy: texels, 0: no shore; z: texels per metre; w: last mip
uniform vec3 viewer;                 // world position of the camera
uniform float sea_level_m;           // height of still water
uniform vec4 grid;                   // xy: corner; z: metres per step; w: steps along a patch
uniform vec4 grid_shape;             // xy: middle; z: steps along a side; w: finest level
uniform vec4 fade;                   // xy: centre; z: distance of the end; w: 1 / width of the fade
uniform vec4 spacing; // x: between vertices per metre of distance; y: minimum; z: last mip
uniform float roughness_between_texels;

uniform vec4 water_colour : hint_color = vec4(0.004, 0.052, 0.075, 1.0);
uniform vec4 crest_colour : hint_color = vec4(0.03, 0.19, 0.19, 1.0); // light through thin water
uniform vec4 foam_colour : hint_color = vec4(0.86, 0.9, 0.92, 1.0);

varying vec2 rest;   // undisplaced position
varying vec3 place;  // displaced position

vec4 place_of_cascade(int cascade) {
	if (cascade == 0) return cascade_place_0;
	if (cascade == 1) return cascade_place_1;
	if (cascade == 2) return cascade_place_2;
	return cascade_place_3;
}

vec4 scale_of_cascade(int cascade) {
	if (cascade == 0) return cascade_scale_0;
	if (cascade == 1) return cascade_scale_1;
	if (cascade == 2) return cascade_scale_2;
	return cascade_scale_3;
}

vec4 foam_of_cascade(int cascade) {
	if (cascade == 0) return cascade_foam_0;
	if (cascade == 1) return cascade_foam_1;
	if (cascade == 2) return cascade_foam_2;
	return cascade_foam_3;
}

float largest(vec4 values) {
	return max(max(values.x, values.y), max(values.z, values.w));
}

// Returns the foam of water that breaks with these sums of compressions.
vec4 breaking(vec4 sums) {
	return clamp(0.5 + (sums - foam_level) / 0.3, 0.0, 1.0);
}

// Returns 1 in the component of the cascade. The engine's shaders have no variable indices.
vec4 component_of_cascade(int cascade) {
	return vec4(float(cascade == 0), float(cascade == 1), float(cascade == 2), float(cascade == 3));
}

vec2 place_in_cascade(vec4 cascade, vec2 at) {
	return cascade.xy + vec2(cascade.z * at.x + cascade.w * at.y, cascade.z * at.y - cascade.w * at.x);
}

// Weight of a cascade, which falls to 0 over the mip before the last: coarser mips have no waves.
float weight_of_mip(float mip) {
	return clamp(spacing.z - 1.0 - mip, 0.0, 1.0);
}

// Returns height, slopes along x and z, and foam of dynamic waves, or 0 outside their grid.
// `apart_m` is the distance between samples.
vec4 dynamic_waves(vec2 at, float apart_m) {
	vec2 from_middle = abs(at - dynamic_waves_extent.xy);
	if (max(from_middle.x, from_middle.y) >= dynamic_waves_extent.z) return vec4(0.0);
	vec2 uv = dynamic_waves_place.xy + at * dynamic_waves_place.z;
	return textureLod(dynamic_waves_texels, uv, max(log2(apart_m * dynamic_waves_place.w), 0.0));
}

bool has_shore() {
	return shore_size.x > 0.0;
}

vec2 shore_uv(vec2 at) {
	return shore_place.xy + at * shore_place.zw;
}

// Returns the weights of the cascades at a displaced position. Beyond the shore's rectangle they
// are those of its nearest edge.
vec4 weights_of_cascades(vec2 at) {
	return textureLod(shore_weights, shore_uv(at), 0.0);
}

// Returns the mip whose texels have the length long_m.
float shore_mip(float long_m) {
	return clamp(log2(max(long_m * shore_size.z, 1e-6)), 0.0, shore_size.w);
}

// Texels of coarse mips on the edges cover the inside of the rectangle, so waves fade out within
// one texel of the mip.
vec4 shore_water_at(vec2 at, float mip) {
	vec2 uv = shore_uv(at);
	vec2 within = (0.5 - abs(uv - 0.5)) * shore_size.xy - 0.5; // texels of mip 0
	float there = clamp((min(within.x, within.y) + 1e-3) / max(exp2(mip) - 1.0, 1e-3), 0.0, 1.0);
	return textureLod(shore_water, uv, mip) * there;
}

float shore_row(vec3 columns, vec3 weights, float row) {
	return weights.x * textureLod(shore_water, vec2(columns.x, row), 0.0).x
			+ weights.y * textureLod(shore_water, vec2(columns.y, row), 0.0).x
			+ weights.z * textureLod(shore_water, vec2(columns.z, row), 0.0).x;
}

// Returns the height of the shore's waves. The finest mip is interpolated with cubics (Keys 1981),
// as in queries: 4 x 4 texels in 3 x 3 linear samples, of which the middle ones combine two texels.
// Coarser mips are linear.
float shore_height_at(vec2 at, float mip) {
	float coarse = shore_water_at(at, mip).x;
	if (mip >= 1.0) return coarse;
	vec2 texels = clamp(shore_uv(at) * shore_size.xy - 0.5, vec2(0.0), shore_size.xy - 1.0);
	vec2 texel = floor(texels);
	vec2 t = texels - texel;
	vec2 before = 0.5 * t * (t * (2.0 - t) - 1.0);
	vec2 here = 0.5 * (t * t * (3.0 * t - 5.0) + 2.0);
	vec2 after = 0.5 * t * t * (t - 1.0);
	vec2 both = 1.0 - before - after;
	vec2 first = (texel - 0.5) / shore_size.xy;
	vec2 middle = (texel + 1.5 - here / both) / shore_size.xy;
	vec2 last = (texel + 2.5) / shore_size.xy;
	vec3 columns = vec3(first.x, middle.x, last.x);
	vec3 weights = vec3(before.x, both.x, after.x);
	float fine = before.y * shore_row(columns, weights, first.y) + both.y * shore_row(columns, weights, middle.y)
			+ after.y * shore_row(columns, weights, last.y);
	return mix(fine, coarse, mip);
}

// Returns the displacement of a vertex. Mips depend on the undisplaced position alone, so they are
// equal in all patches that share the vertex.
vec3 displaced(vec2 index, sampler2DArray maps) {
	vec2 at = grid.xy + index * grid.z;
	vec2 from_centre = abs(at - fade.xy);
	float attenuation = clamp((fade.z - max(from_centre.x, from_centre.y)) * fade.w, 0.0, 1.0);
	float step_m = max(spacing.y, length(vec3(at.x, viewer.y - sea_level_m, at.y)) * spacing.x);
	vec4 xs = vec4(0.0); // one component per cascade
	vec4 heights = vec4(0.0);
	vec4 zs = vec4(0.0);
	for (int cascade = 0; cascade < cascades; cascade++) {
		float mip = max(log2(step_m * scale_of_cascade(cascade).x) - 0.5, 0.0);
		float weight = weight_of_mip(mip);
		if (weight > 0.0) {
			vec2 uv = place_in_cascade(place_of_cascade(cascade), at);
			vec3 texel = attenuation * weight * textureLod(maps, vec3(uv, float(cascade)), mip).xyz;
			vec4 component = component_of_cascade(cascade);
			xs += texel.x * component;
			heights += texel.y * component;
			zs += texel.z * component;
		}
	}
	vec4 at_shore = vec4(1.0);
	if (has_shore()) {
		// The weights are those of the displaced position, which depends on them. They change
		// over lengths much larger than the displacement, so two iterations suffice.
		at_shore = weights_of_cascades(at);
		at_shore = weights_of_cascades(at + vec2(dot(at_shore, xs), dot(at_shore, zs)));
		at_shore = weights_of_cascades(at + vec2(dot(at_shore, xs), dot(at_shore, zs)));
	}
	vec3 moved = vec3(dot(at_shore, xs), dot(at_shore, heights), dot(at_shore, zs));
	if (has_shore()) moved.y += attenuation * shore_height_at(at + moved.xz, shore_mip(step_m));
	// Half a level finer, like the mips of the cascades.
	moved.y += attenuation * dynamic_waves(at + moved.xz, step_m * 0.7071068).x;
	return moved;
}

// Vertices of the skirt have a y of 1 on the border of the grid and 2 at the end of the flat sea.
vec2 skirt_place(vec3 vertex, vec3 piece) {
	float stride = exp2(grid_shape.w - piece.y);
	float side = piece.z; // 0 east, 1 north, 2 west, 3 south
	bool runs_down = side == 1.0 || side == 2.0;
	float along = piece.x + (runs_down ? grid.w - vertex.x : vertex.x) * stride;
	float across = side < 1.5 ? grid_shape.z : 0.0;
	bool along_z = side == 0.0 || side == 2.0;
	vec2 inner = grid.xy + (along_z ? vec2(across, along) : vec2(along, across)) * grid.z;
	return vertex.y < 1.5 ? inner : grid_shape.xy + (inner - grid_shape.xy) * 20.0;
}

void vertex() {
	vec3 instance = WORLD_MATRIX[3].xyz; // x and z: corner of the patch in steps; y: its level
	vec3 moved = vec3(0.0);
	if (VERTEX.y > 0.5) {
		rest = skirt_place(VERTEX, instance);
	} else {
		vec2 ij = VERTEX.xz;
		float stride = exp2(grid_shape.w - instance.y);
		vec2 index = instance.xz + ij * stride;
		moved = displaced(index, displacement);
		vec2 odd = mod(ij, 2.0);
		if (odd.x + odd.y > 0.5) {
			// Vertices that the next coarser level lacks morph between its surface and their own.
			float weight = COLOR.x;
			if (ij.x == 0.0) weight = INSTANCE_CUSTOM.z;
			if (ij.x == grid.w) weight = INSTANCE_CUSTOM.x;
			if (ij.y == 0.0) weight = INSTANCE_CUSTOM.w;
			if (ij.y == grid.w) weight = INSTANCE_CUSTOM.y;
			if (weight < 1.0) {
				vec2 offset = odd;
				bool is_flipped = mod(floor(ij.x / 2.0) + floor(ij.y / 2.0) + COLOR.y, 2.0) > 0.5;
				if (odd.x + odd.y > 1.5 && is_flipped) offset.y = -1.0;
				offset *= stride;
				vec3 coarse = 0.5 * (displaced(index - offset, displacement) + displaced(index + offset, displacement));
				moved = mix(coarse, moved, weight);
			}
		}
		rest = grid.xy + index * grid.z;
	}
	place = vec3(rest.x + moved.x, moved.y + (sea_level_m - viewer.y), rest.y + moved.z);
	// The camera may have moved after the node set the uniforms.
	VERTEX = mat3(INV_CAMERA_MATRIX) * (place + (viewer - CAMERA_MATRIX[3].xyz));
	NORMAL = mat3(INV_CAMERA_MATRIX) * vec3(0.0, 1.0, 0.0);
}

void fragment() {
	vec2 h = vec2(0.0);
	vec3 d = vec3(0.0); // D_xx, D_zz, D_xz
	float variance = 0.0;
	float present = 0.0; // sum of the compressions now, and in the four images of snapshots
	vec4 past_0 = vec4(0.0);
	vec4 past_1 = vec4(0.0);
	vec4 past_2 = vec4(0.0);
	vec4 past_3 = vec4(0.0);
	// Shorter side of the pixel's footprint on the sea.
	float narrow_m = sqrt(min(dot(dFdx(rest), dFdx(rest)), dot(dFdy(rest), dFdy(rest))));
	vec4 at_shore = has_shore() ? weights_of_cascades(place.xz) : vec4(1.0);
	for (int cascade = 0; cascade < cascades; cascade++) {
		vec4 scale = scale_of_cascade(cascade);
		float weight = dot(at_shore, component_of_cascade(cascade));
		float mip = log2(max(narrow_m * scale.x, 1.0));
		vec2 place_of_texels = place_in_cascade(place_of_cascade(cascade), rest);
		vec4 of_foam = foam_of_cascade(cascade);
		if (of_foam.z > 0.0) {
			// Coarser mips than 1 would lose the fronts, because means of compressions seldom break.
			vec2 drifted = place_of_texels - of_foam.xy;
			float level = min(mip, 1.0);
			past_0 += weight * (8.0 * textureLod(snapshots, vec3(drifted, float(cascade)), level) - 3.0);
			past_1 += weight * (8.0 * textureLod(snapshots, vec3(drifted, float(cascades + cascade)), level) - 3.0);
			past_2 += weight * (8.0 * textureLod(snapshots, vec3(drifted, float(2 * cascades + cascade)), level) - 3.0);
			past_3 += weight * (8.0 * textureLod(snapshots, vec3(drifted, float(3 * cascades + cascade)), level) - 3.0);
		}
		if (weight_of_mip(mip) <= 0.0) {
			variance += weight * weight * scale.w; // the pixel resolves none of its waves
			continue;
		}
		vec3 uv = vec3(place_of_texels, float(cascade));
		vec4 slope = (texture(slopes, uv) * (255.0 / 127.0) - 128.0 / 127.0) * scale.y;
		vec4 moment = texture(moments, uv);
		h += weight * slope.xy;
		d += weight * vec3(slope.zw, (moment.x * (255.0 / 127.0) - 128.0 / 127.0) * scale.y);
		variance += weight * weight * (moment.y + moment.z) * scale.z;
		present -= weight * of_foam.z * (slope.z + slope.w + dot(foam_front.xy, slope.xy));
	}
	// Water whose height adds at the displaced position: slopes along x and z, and foam.
	vec4 added = dynamic_waves(place.xz, narrow_m);
	if (has_shore()) {
		vec4 water = shore_water_at(place.xz, shore_mip(narrow_m));
		added = vec4(added.xyz + water.xyz, max(added.w, water.w));
	}
	float foam = max(added.w, breaking(vec4(present)).x);
	foam = max(foam, largest(breaking(past_0) - snapshot_ages_0));
	foam = max(foam, largest(breaking(past_1) - snapshot_ages_1));
	foam = max(foam, largest(breaking(past_2) - snapshot_ages_2));
	foam = max(foam, largest(breaking(past_3) - snapshot_ages_3));
	float jacobian = (1.0 + d.x) * (1.0 + d.y) - d.z * d.z;
	vec3 normal = vec3(h.y * d.z - h.x * (1.0 + d.y), max(jacobian, 0.2), h.x * d.z - h.y * (1.0 + d.x));
	normal.xz -= normal.y * added.yz;
	vec3 to_eye = -normalize(place);
	normal = normalize(normal);
	// Surfaces that face away from the eye are hidden, so normals are bent towards it.
	float away = dot(normal, to_eye);
	if (away < 0.02) normal = normalize(normal + (0.02 - away) * to_eye);
	NORMAL = mat3(INV_CAMERA_MATRIX) * normal;
	float alpha2 = variance + roughness_between_texels * roughness_between_texels;
	float crest = clamp(0.15 + 0.25 * (place.y + viewer.y - sea_level_m), 0.0, 1.0) * clamp(1.0 - to_eye.y, 0.0, 1.0);
	vec3 water = mix(water_colour.rgb, crest_colour.rgb, crest);
	ALBEDO = mix(water, foam_colour.rgb, foam);
	ROUGHNESS = mix(sqrt(sqrt(clamp(alpha2, 0.0001, 1.0))), 0.9, foam);
	SPECULAR = 0.354; // reflects 2 % at normal incidence: refractive index 1.33
}
