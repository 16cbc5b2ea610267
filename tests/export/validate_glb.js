// node validate_glb.js FILE...: what Khronos' validator (npm package gltf-validator) says of GLB files. Exit code 1 where it
// finds an error or a warning.
const fs = require('fs');
const validator = require('gltf-validator');

async function main() {
  let bad = false;
  for (const file of process.argv.slice(2)) {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {maxIssues: 0});
    const {numErrors, numWarnings, numInfos} = report.issues;
    console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} notes, ` +
                `${report.info.drawCallCount} meshes, ${report.info.totalTriangleCount} triangles`);
    for (const m of report.issues.messages.filter((m) => m.severity < 2)) console.log(`  ${m.code} ${m.pointer}: ${m.message}`);
    bad = bad || numErrors + numWarnings > 0;
  }
  process.exit(bad ? 1 : 0);
}
main();
