// Displays the maps of an export with --patch-size 300 --maps displacement,gradient,foam (one
// cascade) on a mesh whose vertices a shader displaces. three.js has Pelagic's axes: x right, y up,
// right-handed.
import * as THREE from "three";
import { EXRLoader } from "three/addons/loaders/EXRLoader.js";
import { Sky } from "three/addons/objects/Sky.js";

// Vertex (i, j) has the reference position x = i L/N, z = j L/N and uses the centre of texel (i,
// j). Texel rows count from the upper edge of the image, v from the lower edge, for both loaders as
// configured here.
export function patch(N, L) {
  const places = [], texels = [], indices = [];
  for (let j = 0; j <= N; ++j) {
    for (let i = 0; i <= N; ++i) {
      places.push(i * L / N, 0, j * L / N);
      texels.push((i + 0.5) / N, 1 - (j + 0.5) / N);
      const a = j * (N + 1) + i, b = a + N + 1;
      if (i < N && j < N) indices.push(a, b, a + 1, a + 1, b, b + 1);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute("uv", new THREE.Float32BufferAttribute(texels, 2));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(places.map((_, k) => k % 3 == 1 ? 1 : 0), 3));
  geometry.setIndex(indices);
  return geometry;
}

// Metres as 32-bit floats. A vertex uses its own texel, so there is no filtering.
export async function displacementMap(url) {
  const map = await new EXRLoader().setDataType(THREE.FloatType).loadAsync(url);
  map.wrapS = map.wrapT = THREE.RepeatWrapping;
  map.minFilter = map.magFilter = THREE.NearestFilter;
  map.generateMipmaps = false;
  map.colorSpace = THREE.NoColorSpace;
  return map;
}

// Unmodified bytes: the browser would multiply normals by the smoothness in the alpha channel.
export async function byteMap(url) {
  const bytes = await new THREE.ImageBitmapLoader()
    .setOptions({ imageOrientation: "flipY", premultiplyAlpha: "none", colorSpaceConversion: "none" }).loadAsync(url);
  const map = new THREE.Texture(bytes);
  map.flipY = map.premultiplyAlpha = false;
  map.wrapS = map.wrapT = THREE.RepeatWrapping;
  map.colorSpace = THREE.NoColorSpace;
  map.needsUpdate = true;
  return map;
}

export const drawnPlace = `
uniform sampler2D displacement;
vec3 drawn_place(vec3 rest, vec2 texel) { return rest + texture2D(displacement, texel).xyz; }
`;

export const decodedGradient = `
uniform sampler2D gradient;
// The normal, and J in w.
vec4 decoded_gradient(vec2 texel) {
  vec3 v = 2.0 * texture2D(gradient, texel).rgb - 1.0;
  float y = sqrt(max(0.0, 1.0 - v.x * v.x - v.y * v.y));
  return vec4(v.x, v.z < 0.0 ? -y : y, v.y, v.z);
}
`;

export function water(displacement, gradient, foam) {
  const material = new THREE.MeshStandardMaterial({ color: 0x0b2b3a, roughness: 0.12, side: THREE.DoubleSide });
  material.defines = { USE_UV: "" };
  material.onBeforeCompile = (shader) => {
    shader.uniforms.displacement = { value: displacement };
    shader.uniforms.gradient = { value: gradient };
    shader.uniforms.foam = { value: foam };
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>" + drawnPlace)
      .replace("#include <begin_vertex>", "vec3 transformed = drawn_place(position, uv);");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>" + decodedGradient + "uniform mat3 normalMatrix; uniform sampler2D foam;")
      .replace("#include <color_fragment>", "vec4 slope = decoded_gradient(vUv);\n" +
        "diffuseColor.rgb = mix(diffuseColor.rgb, vec3(0.85), texture2D(foam, vUv).r);")
      .replace("#include <normal_fragment_begin>", "vec3 normal = normalize(normalMatrix * slope.xyz);\n" +
        "vec3 nonPerturbedNormal = normal;");
  };
  return material;
}

export async function show(canvas, folder) {
  const record = await (await fetch(folder + "/sea.json")).json();
  const N = record.sea.resolution, L = record.sea.patch_size_m, patches = 3;
  const urlOf = (map) => folder + "/" + record.frames[0].files.find((file) => file.name.startsWith(map)).name;
  const material = water(await displacementMap(urlOf("displacement")), await byteMap(urlOf("gradient")),
                         await byteMap(urlOf("foam")));

  const scene = new THREE.Scene();
  const sea = new THREE.InstancedMesh(patch(N, L), material, patches * patches);
  for (let k = 0; k < patches * patches; ++k)
    sea.setMatrixAt(k, new THREE.Matrix4().makeTranslation(k % patches * L, 0, Math.floor(k / patches) * L));
  sea.frustumCulled = false;
  scene.add(sea);

  const sun = new THREE.Vector3().setFromSphericalCoords(1, 1.15, -2.2);
  const light = new THREE.DirectionalLight(0xfff2e0, 2);
  light.position.copy(sun);
  scene.add(light);
  const sky = new Sky();
  sky.scale.setScalar(1e4);
  sky.material.uniforms.sunPosition.value.copy(sun);
  sky.material.uniforms.rayleigh.value = 1.2;
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
  renderer.setSize(canvas.width, canvas.height, false);
  renderer.toneMapping = THREE.ACESFilmicToneMapping;
  renderer.toneMappingExposure = 0.35;
  const surroundings = new THREE.Scene();
  surroundings.add(sky);
  scene.environment = new THREE.PMREMGenerator(renderer).fromScene(surroundings).texture;
  scene.add(sky);

  const highest = Math.max(...record.frames.map((frame) => frame.height_max_m));
  const camera = new THREE.PerspectiveCamera(45, canvas.width / canvas.height, 0.5, 2e4);
  camera.position.set(0.9 * L, 2 * highest + 2, 2.1 * L);
  camera.lookAt(1.9 * L, -2 * highest, 1.1 * L);
  renderer.render(scene, camera);
  return { record, renderer, material };
}
