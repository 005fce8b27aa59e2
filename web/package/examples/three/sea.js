// A sea in three.js: a mesh displaced by Pelagic's maps, lit by sun and sky. A worker computes it.
import * as THREE from 'three';
import { createOcean, levelCount, levelOffset } from 'pelagic/worker';
import { seaShaders, skyShaders } from './shaders.js';

const ocean = await createOcean({ preset: 'moderate', maps: ['displacement', 'slopes', 'moments'] });
let frame = await ocean.frameAt(0);
const { resolution } = frame.cascades[0];
const count = frame.cascades.length;

// Textures of each cascade: displacement in half floats, slopes and moments with mipmaps.
function repeating(type, minFilter) {
  const texture = new THREE.DataTexture(null, resolution, resolution, THREE.RGBAFormat, type);
  Object.assign(texture, { wrapS: THREE.RepeatWrapping, wrapT: THREE.RepeatWrapping, magFilter: THREE.LinearFilter, minFilter });
  texture.anisotropy = 8;
  return texture;
}
const displacement = frame.cascades.map(() => repeating(THREE.HalfFloatType, THREE.LinearFilter));
const slopes = frame.cascades.map(() => repeating(THREE.UnsignedByteType, THREE.LinearMipmapLinearFilter));
const moments = frame.cascades.map(() => repeating(THREE.UnsignedByteType, THREE.LinearMipmapLinearFilter));

const levels = (chain) => Array.from({ length: levelCount(resolution) }, (_, level) => {
  const side = resolution >> level, first = 4 * levelOffset(resolution, level);
  return { data: chain.subarray(first, first + 4 * side * side), width: side, height: side };
});

// Sets the maps without copying them; three.js uploads them with the next image.
function show({ cascades }) {
  cascades.forEach((cascade, i) => {
    displacement[i].image.data = cascade.displacement;
    slopes[i].mipmaps = levels(cascade.slopes);
    moments[i].mipmaps = levels(cascade.moments);
    for (const texture of [displacement[i], slopes[i], moments[i]]) texture.needsUpdate = true;
  });
}

// A disc around the eye, up to the horizon, with rings that grow with the distance.
function disc(rings, sectors, nearest, farthest) {
  const positions = [0, 0, 0], indices = [];
  for (let ring = 0; ring < rings; ++ring)
    for (let sector = 0; sector < sectors; ++sector) {
      const radius = nearest * (farthest / nearest) ** (ring / (rings - 1)), angle = (2 * Math.PI * (sector + ring / 2)) / sectors;
      positions.push(radius * Math.cos(angle), 0, radius * Math.sin(angle));
      const here = 1 + ring * sectors + sector, next = 1 + ring * sectors + (sector + 1) % sectors;
      if (ring === 0) indices.push(0, next, here);
      else indices.push(here - sectors, next, here, here - sectors, next - sectors, next);
    }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
  geometry.setIndex(indices);
  return geometry;
}

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.toneMapping = THREE.ACESFilmicToneMapping;
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(55, 1, 0.1, 40000);
camera.position.set(0, 6, 0);

const uniforms = {
  displacement: { value: displacement },
  slopes: { value: slopes },
  moments: { value: moments },
  // For each cascade: side and rotation, and the units of its bytes.
  grid: { value: frame.cascades.map((cascade) => new THREE.Vector3(cascade.sideM, cascade.cosine, cascade.sine)) },
  ranges: { value: frame.cascades.map((cascade) => new THREE.Vector2(cascade.slopeRange, cascade.varianceRange)) },
  compressionScale: { value: frame.cascades.map((cascade) => cascade.compressionScale) },
  compressionFront: { value: new THREE.Vector2(frame.cascades[0].compressionFrontX, frame.cascades[0].compressionFrontZ) },
  foamLevel: { value: frame.statistics.foamLevel },
  unresolved: { value: frame.statistics.unresolvedSlopes.upwind + frame.statistics.unresolvedSlopes.crosswind },
  sun: { value: new THREE.Vector3(0.25, 0.2, -1).normalize() },
};
const sea = new THREE.Mesh(disc(420, 512, 0.5, 30000), new THREE.ShaderMaterial({ uniforms, ...seaShaders(count) }));
sea.frustumCulled = false;
const dome = new THREE.Mesh(new THREE.SphereGeometry(35000), new THREE.ShaderMaterial({ uniforms, side: THREE.BackSide, depthWrite: false, ...skyShaders }));
scene.add(dome, sea);

function resize() {
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
addEventListener('resize', resize);
resize();

// The worker computes the next frame while one is drawn. If it is late, the last frame is drawn
// again.
let isComputing = false;
renderer.setAnimationLoop((milliseconds) => {
  if (!isComputing) {
    isComputing = true;
    ocean.frameAt(milliseconds / 1000).then((next) => {
      frame = next;
      show(frame);
      isComputing = false;
    });
  }
  camera.lookAt(0.2, 4.6, -10);
  renderer.render(scene, camera);
});
show(frame);
document.title = `Pelagic in three.js, ${ocean.threads} threads`;
