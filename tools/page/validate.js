// glTF files by the Khronos validator: no error, no warning. `node validate.js FILE...`
const { readFileSync } = require("fs");
const validator = require("gltf-validator");

async function main(files) {
  let bad = files.length === 0;
  for (const file of files) {
    const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), { maxIssues: 20 });
    const { numErrors, numWarnings, messages } = report.issues;
    if (numErrors || numWarnings) {
      bad = true;
      console.error(file, messages);
    }
  }
  console.log(`${files.length} glTF files by the validator`);
  process.exit(bad ? 1 : 0);
}

main(process.argv.slice(2));
