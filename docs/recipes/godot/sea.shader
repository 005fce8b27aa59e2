shader_type spatial;
render_mode cull_disabled;

uniform sampler2D displacement;
uniform sampler2D gradient;
uniform sampler2D foam;

void vertex() {
	VERTEX += textureLod(displacement, UV, 0.0).xyz;
}

void fragment() {
	// Normal x, normal z, J: bytes of [-1, 1].
	vec3 v = 2.0 * texture(gradient, UV).rgb - 1.0;
	float y = sqrt(max(0.0, 1.0 - v.x * v.x - v.y * v.y));
	vec3 normal = vec3(v.x, v.z < 0.0 ? -y : y, v.y);
	NORMAL = normalize((INV_CAMERA_MATRIX * vec4(normal, 0.0)).xyz);
	ALBEDO = mix(vec3(0.01, 0.045, 0.065), vec3(0.85), texture(foam, UV).r);
	ROUGHNESS = 0.12;
	SPECULAR = 0.5;
}
