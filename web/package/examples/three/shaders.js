// Shaders of water and sky. The sums over cascades follow docs/api.md, "Sum of cascades".

const skyColour = `
  uniform vec3 sun;
  // Deep blue above, bright at the horizon, warm around the sun.
  vec3 skyAt(vec3 direction) {
    float height = max(direction.y, 0.0), towards = max(dot(direction, sun), 0.0);
    vec3 colour = mix(vec3(0.44, 0.58, 0.74), vec3(0.05, 0.15, 0.42), pow(height, 0.45));
    colour += vec3(1.0, 0.62, 0.32) * (0.35 * pow(towards, 8.0) + 0.5 * pow(towards, 60.0)) * (1.0 - 0.6 * height);
    return colour;
  }`;

// Repeats `body` for each cascade, because samplers can be indexed by constants only.
const forEachCascade = (count, body) => Array.from({ length: count }, (_, cascade) => `{ ${body.replaceAll('CASCADE', cascade)} }`).join('\n');

const grids = (count) => `
  uniform vec3 grid[${count}];  // side, cosine and sine of the rotation
  // Returns an undisplaced position in texture coordinates; texel 0 is at the origin.
  vec2 placeIn(vec3 cascade, vec2 rest, ivec2 texels) {
    return vec2(cascade.y * rest.x + cascade.z * rest.y, cascade.y * rest.y - cascade.z * rest.x) / cascade.x + 0.5 / vec2(texels);
  }`;

export const skyShaders = {
  vertexShader: `
    varying vec3 direction;
    void main() {
      direction = position;
      gl_Position = projectionMatrix * mat4(mat3(viewMatrix)) * vec4(position, 1.0);
    }`,
  fragmentShader: `
    varying vec3 direction;
    ${skyColour}
    void main() {
      vec3 d = normalize(direction);
      vec3 colour = skyAt(d) + vec3(40.0, 32.0, 22.0) * smoothstep(0.99985, 0.9999, dot(d, sun));
      gl_FragColor = vec4(colour, 1.0);
      #include <tonemapping_fragment>
      #include <colorspace_fragment>
    }`,
};

const vertexShader = (count) => `
  uniform sampler2D displacement[${count}];
  varying vec3 place;
  varying vec2 rest;
  ${grids(count)}
  void main() {
    rest = position.xz + cameraPosition.xz;
    float distance = length(position.xz);
    vec3 moved = vec3(0.0);
    ${forEachCascade(count, `
      vec4 texel = textureLod(displacement[CASCADE], placeIn(grid[CASCADE], rest, textureSize(displacement[CASCADE], 0)), 0.0);
      // Waves shorter than the mesh's cells fade with distance; their slopes remain.
      moved += texel.xyz * (1.0 - smoothstep(2.0, 8.0, distance / grid[CASCADE].x));`)}
    place = vec3(rest.x, 0.0, rest.y) + moved;
    gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
  }`;

const fragmentShader = (count) => `
  uniform sampler2D slopes[${count}], moments[${count}];
  uniform vec2 ranges[${count}];
  uniform float compressionScale[${count}], foamLevel, unresolved;
  uniform vec2 compressionFront;
  varying vec3 place;
  varying vec2 rest;
  ${skyColour}
  ${grids(count)}
  const float zero = 128.0 / 127.0, one = 255.0 / 127.0;  // a byte b is (b - 128)/127

  void main() {
    // Sums of the derivatives, and of the variances of slopes within texels.
    vec2 h = vec2(0.0);
    vec3 d = vec3(0.0);  // D_xx, D_zz, D_xz
    float variance = unresolved, compression = 0.0;
    ${forEachCascade(count, `
      vec2 at = placeIn(grid[CASCADE], rest, textureSize(slopes[CASCADE], 0));
      vec4 slope = (texture2D(slopes[CASCADE], at) * one - zero) * ranges[CASCADE].x, moment = texture2D(moments[CASCADE], at);
      vec3 own = vec3(slope.zw, (moment.x * one - zero) * ranges[CASCADE].x);
      h += slope.xy;
      d += own;
      variance += (moment.y + moment.z) * ranges[CASCADE].y;
      compression -= compressionScale[CASCADE] * (own.x + own.y + dot(compressionFront, slope.xy));`)}
    float j = (1.0 + d.x) * (1.0 + d.y) - d.z * d.z;
    vec3 normal = normalize(vec3(h.y * d.z - h.x * (1.0 + d.y), max(j, 0.05), h.x * d.z - h.y * (1.0 + d.x)));

    vec3 toEye = cameraPosition - place;
    float distance = length(toEye);
    toEye /= distance;
    // Facets that face away are occluded by others.
    float facing = max(dot(normal, toEye), 0.02);
    normal = normalize(normal + toEye * max(0.02 - dot(normal, toEye), 0.0));

    float fresnel = 0.02 + 0.98 * pow(1.0 - facing, 5.0) / (1.0 + 9.0 * sqrt(variance));
    vec3 mirrored = reflect(-toEye, normal);
    mirrored.y = abs(mirrored.y) + 0.4 * sqrt(variance);
    vec3 light = skyAt(normalize(mirrored));

    // Light scattered in the water, stronger in crests in front of the sun.
    float through = pow(max(dot(-toEye, sun), 0.0), 3.0) * max(place.y, 0.0) * 0.12;
    vec3 body = vec3(0.006, 0.045, 0.065) + vec3(0.02, 0.11, 0.09) * (0.25 * max(dot(normal, sun), 0.0) + through);

    // Sun glitter of unresolved slopes (Cox and Munk 1954).
    vec3 half_ = normalize(sun + toEye);
    vec3 local = half_ / max(half_.y, 1e-3) - normal / max(normal.y, 1e-3);
    float spread = max(variance, 1e-3);
    float glitter = exp(-dot(local.xz, local.xz) / spread) / (3.14159 * spread * pow(max(half_.y, 0.1), 4.0));
    float mirror = 0.02 + 0.98 * pow(1.0 - max(dot(half_, toEye), 0.0), 5.0);
    vec3 colour = mix(body, light, fresnel) + vec3(4.2, 3.3, 2.2) * mirror * glitter / (4.0 * max(facing, 0.1));

    // Water that breaks now.
    float cover = clamp(0.5 + (compression - foamLevel) / 0.3, 0.0, 1.0) * smoothstep(3000.0, 200.0, distance);
    colour = mix(colour, vec3(0.75, 0.78, 0.8) * (0.5 + 0.5 * max(dot(normal, sun), 0.0)), 0.85 * cover);
    // Haze.
    vec3 haze = skyAt(normalize(vec3(-toEye.x, 0.015, -toEye.z)));
    colour = mix(colour, haze, 1.0 - exp(-distance / 9000.0));
    gl_FragColor = vec4(colour, 1.0);
    #include <tonemapping_fragment>
    #include <colorspace_fragment>
  }`;

export const seaShaders = (count) => ({ vertexShader: vertexShader(count), fragmentShader: fragmentShader(count) });
