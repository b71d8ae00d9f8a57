// SPDX-License-Identifier: MIT
// Runs what onnx_runtime.py wrote in ONNX Runtime: node onnx_runtime.cjs PACKAGE FOLDER. Status 1 when an output differs
// by more than 1e-9 of its network's largest output.
const fs = require('fs');
const path = require('path');

const [packageFolder, folder] = process.argv.slice(2);
const ort = require(packageFolder);
const largestDifference = 1e-9;

function values(one, name) {
  const bytes = fs.readFileSync(path.join(folder, one.model, `${one.network}.${name}.f64`));
  return new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
}

async function difference(one) {
  const session = await ort.InferenceSession.create(path.join(folder, one.model, `${one.network}.onnx`));
  const feeds = {};
  for (const name of session.inputNames) feeds[name] = new ort.Tensor('float64', values(one, name), one.shapes[name]);
  const computed = (await session.run(feeds))[one.output].data;
  const given = values(one, one.output);
  if (computed.length !== given.length) throw new Error(`${one.network}: ${computed.length} numbers, not ${given.length}`);
  let largest = 0;
  let worst = 0;
  for (let i = 0; i < given.length; i += 1) {
    if (Number.isNaN(given[i]) !== Number.isNaN(computed[i])) return Infinity;
    if (Number.isNaN(given[i])) continue;
    largest = Math.max(largest, Math.abs(given[i]));
    worst = Math.max(worst, Math.abs(given[i] - computed[i]));
  }
  return worst / largest;
}

async function main() {
  const { version } = JSON.parse(fs.readFileSync(path.join(packageFolder, 'package.json'), 'utf8'));
  console.log(`ONNX Runtime ${version}; largest difference, of the network's largest output`);
  let worst = 0;
  for (const one of JSON.parse(fs.readFileSync(path.join(folder, 'cases.json'), 'utf8'))) {
    const found = await difference(one);
    worst = Math.max(worst, found);
    const rows = one.shapes[one.output][0];
    console.log(`${one.model.padEnd(24)} ${one.network.padEnd(14)} ${String(rows).padStart(7)} rows  ${found.toExponential(1)}`);
  }
  return worst <= largestDifference ? 0 : 1;
}

main().then((status) => { process.exitCode = status; });
