// A small wooden boat. The view moves it by the water's forces on boatHull(); a mooring holds it.
//
// Axes of the boat: x forward, y up from the waterline, z to starboard; metres.

export const length = 7.2, beam = 2.5;
const keelM = -0.55;
/** The water that the hull displaces at rest, up to y = 0. */
const massKg = 4080;
/** Above the centre of that water. */
const centreOfMassM = [-0.76, 0.1, 0];

const normalised = v => v.map(part => part / Math.hypot(...v));
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

// The mesh: positions, normals, colours.

/** Returns half the beam, keel and sheer at s along the hull: transom 0, stem 1. */
function section(s) {
  const fullness = (1 - Math.max(0, (s - 0.3) / 0.7) ** 2.4) * (0.84 + 0.16 * Math.min(1, s / 0.3));
  return {
    half: beam / 2 * Math.max(fullness, 0.012),
    keel: keelM + 0.9 * Math.max(0, (s - 0.7) / 0.3) ** 2.5,
    sheer: 0.62 + 0.16 * (1 - s) ** 2 + 0.62 * s ** 2.6,
  };
}

/** Returns a point of the hull: v is -1 at one gunwale, 0 at the keel, 1 at the other gunwale. */
function hullPoint(s, v) {
  const {half, keel, sheer} = section(s);
  const t = Math.abs(v);
  const rake = 0.5 * s ** 8 * t;  // the stem leans forward
  return [(s - 0.5) * length + rake, keel + (sheer - keel) * t ** 1.7, Math.sign(v) * half * Math.sin(t * Math.PI / 2) ** 0.75];
}

/** Returns the hull of SeaView.setHull(): sections from transom to stem, closed at the gunwales. */
export function boatHull() {
  const sections = steps(0, 1, 10), ring = [-1, -0.7, -0.35, 0, 0.35, 0.7, 1], count = ring.length;
  const triangles = [];
  for (let i = 0; i + 1 < sections.length; ++i)
    for (let j = 0; j < count; ++j) {
      const a = count * i + j, b = count * i + (j + 1) % count;
      triangles.push(a, a + count, b, b, a + count, b + count);
    }
  const stem = count * (sections.length - 1);
  for (let j = 1; j + 1 < count; ++j) triangles.push(0, j, j + 1, stem, stem + j + 1, stem + j);
  return {
    vertices: sections.flatMap(s => ring.flatMap(v => hullPoint(s, v))), triangles, massKg, centreOfMassM,
    skegM2: 0.6, skegXM: -2, rollDamping: 0.1, xM: 0, zM: 0, headingRad: 2.3, mooringPeriodS: 20,
  };
}

function deckPoint(s, v) {
  const {half, sheer} = section(s);
  return [(s - 0.5) * length + 0.4 * s ** 8, sheer - 0.13 + 0.05 * (1 - v * v), v * half * 0.96];
}

const paint = {antifouling: [0.19, 0.025, 0.02], white: [0.72, 0.71, 0.67], strake: [0.02, 0.09, 0.16], deck: [0.33, 0.20, 0.10],
               glass: [0.02, 0.035, 0.045], roof: [0.46, 0.10, 0.03], wood: [0.24, 0.13, 0.06]};

class Mesh {
  values = [];

  triangle(points, normals, colour) {
    points.forEach((point, i) => this.values.push(...point, ...normals[i], ...colour));
  }

  quad(a, b, c, d, colour, normals) {
    const flat = normalised(cross(b.map((x, i) => x - a[i]), d.map((x, i) => x - a[i])));
    const n = normals ?? [flat, flat, flat, flat];
    this.triangle([a, b, c], [n[0], n[1], n[2]], colour);
    this.triangle([a, c, d], [n[0], n[2], n[3]], colour);
  }

  /** Adds a smooth surface; `side` is the sign of its normals. */
  sheet(at, us, vs, side, colourAt) {
    const normal = (u, v) => {
      const e = 1e-3;
      const [a, b, c, d] = [at(u + e, v), at(u - e, v), at(u, v + e), at(u, v - e)];
      return normalised(cross(a.map((x, i) => x - b[i]), c.map((x, i) => x - d[i])).map(x => x * side));
    };
    for (let i = 0; i + 1 < us.length; ++i)
      for (let j = 0; j + 1 < vs.length; ++j) {
        const corners = [[us[i], vs[j]], [us[i + 1], vs[j]], [us[i + 1], vs[j + 1]], [us[i], vs[j + 1]]];
        const points = corners.map(corner => at(...corner));
        this.quad(...points, colourAt(points.reduce((sum, point) => sum + point[1] / 4, 0), (vs[j] + vs[j + 1]) / 2),
                  corners.map(corner => normal(...corner)));
      }
  }

  /** Adds walls from x0 to x1 and -z to z, which lean in by `lean` at the top, and a lid. */
  box(x0, x1, z, y0, y1, lean, colour, lid = colour) {
    this.prism(x0, x1, -z, z, y0, y1, lean, colour, lid);
  }

  post(x, z, half, y0, y1, colour) {
    this.prism(x - half, x + half, z - half, z + half, y0, y1, 0, colour, colour);
  }

  prism(x0, x1, z0, z1, y0, y1, lean, colour, lid) {
    const low = [[x0, y0, z0], [x1, y0, z0], [x1, y0, z1], [x0, y0, z1]];
    const high = [[x0 + lean, y1, z0 + lean], [x1 - lean, y1, z0 + lean], [x1 - lean, y1, z1 - lean], [x0 + lean, y1, z1 - lean]];
    for (let i = 0; i < 4; ++i) {
      const k = (i + 1) % 4;
      this.quad(low[k], low[i], high[i], high[k], colour);
    }
    this.quad(high[3], high[2], high[1], high[0], lid);
  }
}

const steps = (from, to, count) => Array.from({length: count + 1}, (_, i) => from + (to - from) * i / count);

export function boatMesh() {
  const mesh = new Mesh();
  const stations = steps(0.001, 0.999, 40);
  const strakes = [...steps(0.02, 0.55, 8), 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.88, 0.925, 0.965, 1];
  const hullColour = (y, v) => (Math.abs(v) > 0.925 ? paint.wood : Math.abs(v) > 0.85 ? paint.strake : y < 0.07 ? paint.antifouling : paint.white);
  mesh.sheet(hullPoint, stations, strakes, 1, hullColour);
  mesh.sheet(hullPoint, stations, strakes.map(v => -v), 1, hullColour);
  mesh.sheet(deckPoint, stations, steps(-1, 1, 6), -1, () => paint.deck);
  // the transom
  for (const [a, b] of [...strakes.keys()].slice(1).map(i => [strakes[i - 1], strakes[i]]))
    mesh.quad(hullPoint(0, -a), hullPoint(0, a), hullPoint(0, b), hullPoint(0, -b), hullColour(hullPoint(0, a)[1], (a + b) / 2));
  mesh.box(-1.7, 0.35, 0.78, 0.55, 1.35, 0.03, paint.white);
  mesh.box(-1.67, 0.32, 0.75, 1.35, 1.85, 0.07, paint.glass);
  for (const x of [-1.62, -0.68, 0.27])  // posts between the windows
    for (const z of [-0.7, 0.7]) mesh.post(x, z, 0.05, 1.3, 1.87, paint.white);
  mesh.box(-1.8, 0.45, 0.86, 1.85, 1.95, 0.05, paint.roof);
  mesh.post(-0.95, 0, 0.045, 1.95, 3.4, paint.wood);
  mesh.box(1.3, 2.0, 0.42, 0.6, 0.86, 0.05, paint.white, paint.deck);
  return new Float32Array(mesh.values);
}

// Drawing.

const vertexShader = `#version 300 es
uniform mat4 clip_from_world, world_from_boat;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 outwards;
layout(location = 2) in vec3 paint;
out vec3 normal, albedo;
out float above_water;
void main() {
    normal = mat3(world_from_boat) * outwards;
    albedo = paint;
    above_water = position.y;
    gl_Position = clip_from_world * world_from_boat * vec4(position, 1.0);
}`;

// Diffuse paint lit by sun and sky, wet at the waterline. The tone curve is that of
// gl/shaders/film.glsl, as for the sea.
const fragmentShader = `#version 300 es
precision highp float;
uniform vec3 sun, sun_irradiance, sky_irradiance;
uniform float exposure;
in vec3 normal, albedo;
in float above_water;
out vec4 colour;
vec3 filmic(vec3 exposed) {
    const mat3 into = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 out_of = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    vec3 v = into * exposed;
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return clamp(out_of * v, 0.0, 1.0);
}
void main() {
    vec3 n = normalize(normal);
    vec3 wet = albedo * mix(0.45, 1.0, smoothstep(0.05, 0.3, above_water));
    // Downward faces see the sea, which reflects about 6 % of the sky's light.
    vec3 irradiance = sun_irradiance * max(dot(n, sun), 0.0) + sky_irradiance * mix(0.06, 1.0, 0.5 + 0.5 * n.y);
    vec3 shown = filmic(wet / 3.14159265 * irradiance * exposure);
    colour = vec4(mix(12.92 * shown, 1.055 * pow(max(shown, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, shown)), 1.0);
}`;

function multiplied(a, b) {
  const product = new Float64Array(16);
  for (let column = 0; column < 4; ++column)
    for (let row = 0; row < 4; ++row)
      for (let k = 0; k < 4; ++k) product[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return product;
}

export class Boat {
  constructor(gl) {
    this.gl = gl;
    this.program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
    const mesh = boatMesh();
    this.count = mesh.length / 9;
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, mesh, gl.STATIC_DRAW);
    for (let i = 0; i < 3; ++i) {
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, 3, gl.FLOAT, false, 36, 12 * i);
    }
    gl.bindVertexArray(null);
    gl.bindBuffer(gl.ARRAY_BUFFER, null);
  }

  /**
   * Draws into the framebuffer of the sea, whose depth buffer occludes it.
   *
   * @param eye     {viewport, view, projection}, as for SeaView.draw()
   * @param place   result of SeaView.hullMatrix()
   * @param light   result of SeaView.lightInfo()
   * @param origin  position of the eye's origin in the world
   */
  draw(eye, place, light, origin) {
    const {gl, program} = this;
    const uniform = name => gl.getUniformLocation(program, name);
    gl.useProgram(program);
    gl.viewport(...eye.viewport);
    gl.uniformMatrix4fv(uniform('clip_from_world'), false, new Float32Array(multiplied(eye.projection, eye.view)));
    gl.uniformMatrix4fv(uniform('world_from_boat'), false, new Float32Array(place.map((number, i) => number - (origin[i - 12] ?? 0))));
    gl.uniform3fv(uniform('sun'), light.direction);
    gl.uniform3fv(uniform('sun_irradiance'), light.sunIrradiance);
    gl.uniform3fv(uniform('sky_irradiance'), light.skyIrradiance);
    gl.uniform1f(uniform('exposure'), light.exposure);
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    gl.bindVertexArray(this.array);
    gl.drawArrays(gl.TRIANGLES, 0, this.count);
    gl.bindVertexArray(null);
    gl.useProgram(null);
    gl.disable(gl.DEPTH_TEST);
  }
}
