// Khronos' validator: no errors and no warnings.
// usage: NODE_PATH=node_modules node gltf_check.js FILE.glb...
const fs = require('fs');
const validator = require('gltf-validator');

(async () => {
  for (const file of process.argv.slice(2)) {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)));
    const {numErrors, numWarnings, messages} = report.issues;
    console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${report.info.totalTriangleCount} triangles, ` +
                `morph targets: ${report.info.hasMorphTargets}`);
    if (numErrors + numWarnings > 0) {
      console.log(messages);
      process.exitCode = 1;
    }
  }
})();
