// Reads every KTX2 file of an export with npm's ktx-parse and zstddec, and compares its levels with
// those of the DDS file beside it.
//
// usage: node ktx2_check.mjs FOLDER_OF_KTX2 FOLDER_OF_DDS
import { readFileSync, readdirSync } from "node:fs";
import { read } from "ktx-parse";
import { ZSTDDecoder } from "zstddec";

const [, , ktx2_folder, dds_folder] = process.argv;
const zstd = new ZSTDDecoder();
await zstd.init();
let count = 0, seen = new Set();
for (const name of readdirSync(ktx2_folder).filter((name) => name.endsWith(".ktx2"))) {
  const texture = read(new Uint8Array(readFileSync(`${ktx2_folder}/${name}`)));
  const levels = texture.levels.map(({ levelData, uncompressedByteLength }) =>
    Buffer.from(texture.supercompressionScheme === 2 ? zstd.decode(levelData, uncompressedByteLength) : levelData));
  const dds = readFileSync(`${dds_folder}/${name.replace(".ktx2", ".dds")}`);
  if (!Buffer.concat(levels).equals(dds.subarray(148))) throw new Error(`${name} and its DDS differ`);
  if (texture.keyValue.KTXorientation !== "rd") throw new Error(`${name}: KTXorientation is ${texture.keyValue.KTXorientation}`);
  if (levels.length !== 1 + Math.log2(texture.pixelWidth)) throw new Error(`${name} has ${levels.length} levels`);
  seen.add(`${name.split("_")[0]} ${texture.vkFormat} ${texture.supercompressionScheme}`);
  ++count;
}
const wanted = ["compression 76 2", "displacement 97 2", "gradient 37 2"];  // VkFormat, Zstandard
if ([...seen].sort().join() !== wanted.join()) throw new Error(`found ${[...seen]}, expected ${wanted}`);
console.log(`ktx-parse read ${count} files, and their levels are those of the DDS files`);
