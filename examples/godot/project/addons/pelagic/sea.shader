// The sea of a PelagicOcean, which sets the uniforms of the upper half each frame. Lengths are metres; places are relative to the
// camera that it drew for, because near it a float has millimetres wherever it is.
shader_type spatial;
render_mode skip_vertex_transform;

uniform sampler2DArray displacement; // of a cascade: Dx, height, Dz, foam
uniform sampler2DArray slopes;       // h_x, h_z, D_xx, D_zz, as bytes of which 128 is zero
uniform sampler2DArray moments;      // D_xz, variances of h_x and h_z within the texel
uniform int cascades = 0;
uniform vec4 cascade_place_0;           // xy: where the camera is in its texture; zw: cosine and sine of its turn over its side
uniform vec4 cascade_place_1;
uniform vec4 cascade_place_2;
uniform vec4 cascade_place_3;
uniform vec4 cascade_scale_0;           // x: texels a metre; y: what slopes count in; z: variances; w: variance of all its slopes
uniform vec4 cascade_scale_1;
uniform vec4 cascade_scale_2;
uniform vec4 cascade_scale_3;
uniform vec3 viewer;                 // the camera, in the world
uniform vec4 grid;                   // xy: the grid's corner; z: metres a step; w: steps along a patch
uniform vec4 grid_shape;             // xy: its middle; z: steps along its side; w: the level of the finest patches
uniform vec4 fade;                   // xy: its centre; z: where waves have gone; w: 1 over the metres in which they go
uniform vec4 spacing;                // x: of vertices for a metre of distance; y: of the finest; z: last mip
uniform float roughness_between_texels;

uniform vec4 water_colour : hint_color = vec4(0.004, 0.052, 0.075, 1.0);
uniform vec4 crest_colour : hint_color = vec4(0.03, 0.19, 0.19, 1.0); // light through thin water
uniform vec4 foam_colour : hint_color = vec4(0.86, 0.9, 0.92, 1.0);

varying vec2 rest;   // where the water rests
varying vec3 place;  // where it is drawn

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

vec2 place_in_cascade(vec4 cascade, vec2 at) {
	return cascade.xy + vec2(cascade.z * at.x + cascade.w * at.y, cascade.z * at.y - cascade.w * at.x);
}

// A cascade leaves before its waves are shorter than what is looked through: at the last levels.
float weight_of_mip(float mip) {
	return clamp(spacing.z - 1.0 - mip, 0.0, 1.0);
}

// The sum of what the cascades hold at a vertex. Mips depend on the reference position alone, so that patches which share the vertex agree.
vec3 displaced(vec2 index, sampler2DArray maps) {
	vec2 at = grid.xy + index * grid.z;
	vec2 from_centre = abs(at - fade.xy);
	float left = clamp((fade.z - max(from_centre.x, from_centre.y)) * fade.w, 0.0, 1.0);
	float step_m = max(spacing.y, length(vec3(at.x, viewer.y, at.y)) * spacing.x);
	vec3 moved = vec3(0.0);
	for (int cascade = 0; cascade < cascades; cascade++) {
		float mip = max(log2(step_m * scale_of_cascade(cascade).x) - 0.5, 0.0);
		float weight = weight_of_mip(mip);
		if (weight > 0.0) moved += weight * textureLod(maps, vec3(place_in_cascade(place_of_cascade(cascade), at), float(cascade)), mip).xyz;
	}
	return moved * left;
}

// Vertices of the skirt have y above 0: 1 on the border, 2 where the flat sea ends.
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
	vec3 instance = WORLD_MATRIX[3].xyz; // x and z: the patch's corner, in steps; y: its level
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
			// Vertices that the next coarser level lacks come from its surface to their own place.
			float weight = COLOR.x;
			if (ij.x == 0.0) weight = INSTANCE_CUSTOM.z;
			if (ij.x == grid.w) weight = INSTANCE_CUSTOM.x;
			if (ij.y == 0.0) weight = INSTANCE_CUSTOM.w;
			if (ij.y == grid.w) weight = INSTANCE_CUSTOM.y;
			if (weight < 1.0) {
				vec2 offset = odd;
				if (odd.x + odd.y > 1.5 && mod(floor(ij.x / 2.0) + floor(ij.y / 2.0) + COLOR.y, 2.0) > 0.5) offset.y = -1.0;
				offset *= stride;
				vec3 coarse = 0.5 * (displaced(index - offset, displacement) + displaced(index + offset, displacement));
				moved = mix(coarse, moved, weight);
			}
		}
		rest = grid.xy + index * grid.z;
	}
	place = vec3(rest.x + moved.x, moved.y - viewer.y, rest.y + moved.z);
	// The camera may have moved since.
	VERTEX = mat3(INV_CAMERA_MATRIX) * (place + (viewer - CAMERA_MATRIX[3].xyz));
	NORMAL = mat3(INV_CAMERA_MATRIX) * vec3(0.0, 1.0, 0.0);
}

void fragment() {
	vec2 h = vec2(0.0);
	vec3 d = vec3(0.0); // D_xx, D_zz, D_xz
	float variance = 0.0;
	float foam = 0.0;
	float narrow_m = sqrt(min(dot(dFdx(rest), dFdx(rest)), dot(dFdy(rest), dFdy(rest)))); // of the pixel's piece of sea
	for (int cascade = 0; cascade < cascades; cascade++) {
		vec4 scale = scale_of_cascade(cascade);
		if (weight_of_mip(log2(max(narrow_m * scale.x, 1.0))) <= 0.0) {
			variance += scale.w; // all of its waves are smaller than the pixel
			continue;
		}
		vec3 uv = vec3(place_in_cascade(place_of_cascade(cascade), rest), float(cascade));
		vec4 slope = (texture(slopes, uv) * (255.0 / 127.0) - 128.0 / 127.0) * scale.y;
		vec4 moment = texture(moments, uv);
		h += slope.xy;
		d += vec3(slope.zw, (moment.x * (255.0 / 127.0) - 128.0 / 127.0) * scale.y);
		variance += (moment.y + moment.z) * scale.z;
		foam = max(foam, texture(displacement, uv).w);
	}
	vec2 from_centre = abs(rest - fade.xy);
	float left = clamp((fade.z - max(from_centre.x, from_centre.y)) * fade.w, 0.0, 1.0);
	float jacobian = (1.0 + d.x) * (1.0 + d.y) - d.z * d.z;
	vec3 normal = vec3(h.y * d.z - h.x * (1.0 + d.y), max(jacobian, 0.2), h.x * d.z - h.y * (1.0 + d.x));
	vec3 to_eye = -normalize(place);
	normal = normalize(normal);
	// What faces away is hidden behind what does not: lean it towards the eye.
	float away = dot(normal, to_eye);
	if (away < 0.02) normal = normalize(normal + (0.02 - away) * to_eye);
	NORMAL = mat3(INV_CAMERA_MATRIX) * normal;
	float alpha2 = variance + roughness_between_texels * roughness_between_texels;
	float crest = clamp(0.15 + 0.25 * (place.y + viewer.y), 0.0, 1.0) * clamp(1.0 - to_eye.y, 0.0, 1.0);
	vec3 water = mix(water_colour.rgb, crest_colour.rgb, crest);
	ALBEDO = mix(water, foam_colour.rgb, foam);
	ROUGHNESS = mix(sqrt(sqrt(clamp(alpha2, 0.0001, 1.0))), 0.9, foam);
	SPECULAR = 0.354; // 2 % at right angles, of an index of 1.33
}
