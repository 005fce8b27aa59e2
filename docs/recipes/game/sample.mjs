// Computes a displaced position of the sea of an export with --format ktx2, like a vertex shader.
//
// usage: node sample.mjs FOLDER X Z
// X and Z are a reference position in metres; prints x, y and z of its water in frame 0.
import { readFileSync } from "node:fs";
import { read } from "ktx-parse";
import { ZSTDDecoder } from "zstddec";

const [folder, x, z] = [process.argv[2], Number(process.argv[3]), Number(process.argv[4])];
const sea = JSON.parse(readFileSync(`${folder}/sea.json`, "utf8"));
const zstd = new ZSTDDecoder();
await zstd.init();

// The texture's largest level, RGBA as 16-bit floats, rows from the upper edge.
function displacement(name) {
  const texture = read(new Uint8Array(readFileSync(`${folder}/${name}`)));
  const { levelData, uncompressedByteLength } = texture.levels[0];
  const bytes = texture.supercompressionScheme === 2 ? zstd.decode(levelData, uncompressedByteLength) : levelData;
  return { side: texture.pixelWidth, halves: new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength) };
}

function half(bits) {
  const exponent = (bits >> 10) & 31, mantissa = bits & 1023;
  const size = exponent === 0 ? mantissa * 2 ** -24 : (1 + mantissa / 1024) * 2 ** (exponent - 15);
  return bits & 0x8000 ? -size : size;
}

// Filters like a GPU with a repeating texture.
function bilinear({ side, halves }, u, v) {
  const column = u * side - 0.5, row = v * side - 0.5;
  const left = Math.floor(column), top = Math.floor(row);
  const wrapped = (number) => ((number % side) + side) % side;
  const value = (i, j, channel) => half(halves.getUint16(8 * (wrapped(j) * side + wrapped(i)) + 2 * channel, true));
  return [0, 1, 2].map((channel) => {
    const mix = (a, b, part) => a + (b - a) * part;
    const upper = mix(value(left, top, channel), value(left + 1, top, channel), column - left);
    const lower = mix(value(left, top + 1, channel), value(left + 1, top + 1, channel), column - left);
    return mix(upper, lower, row - top);
  });
}

const drawn = [x, 0, z];
for (const cascade of sea.layout.cascades) {
  const mark = cascade.in_file_names ? `${cascade.in_file_names}_` : "";
  const texture = displacement(`displacement_${mark}0000.ktx2`);
  const { cosine: c, sine: s } = cascade.rotation;
  const u = (c * x + s * z) / cascade.side_m + 0.5 / cascade.resolution;
  const v = (c * z - s * x) / cascade.side_m + 0.5 / cascade.resolution;
  bilinear(texture, u, v).forEach((value, axis) => (drawn[axis] += value));
}
console.log(drawn.join(" "));
