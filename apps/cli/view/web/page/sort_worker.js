/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Runs in a worker: orders Gaussians from far to near, by the depth of their centres along the optical axis or by their
   distance, as the map's colours were trained. The keys are the bits of positive floats, which ascend with the value;
   two stable counting sorts of 16 bits each. */

let positions = new Float32Array(0);
let keys = new Uint32Array(0);
let first = new Uint32Array(0);
const starts = new Uint32Array(65537);

/* Appends each index of `from` (or n - 1 .. 0 if it is null) to the bucket of its key's digit. */
function countingSort(from, to, shift) {
  const n = keys.length;
  starts.fill(0);
  for (let i = 0; i < n; ++i) ++starts[(keys[i] >>> shift & 65535) + 1];
  for (let d = 0; d < 65536; ++d) starts[d + 1] += starts[d];
  for (let i = 0; i < n; ++i) {
    const g = from === null ? n - 1 - i : from[i];
    to[starts[keys[g] >>> shift & 65535]++] = g;
  }
}

onmessage = (event) => {
  const request = event.data;
  if (request.positions) {
    positions = request.positions;
    keys = new Uint32Array(positions.length / 3);
    first = new Uint32Array(keys.length);
    return;
  }
  const values = new Float32Array(keys.buffer);
  const [cx, cy, cz] = request.centre, [fx, fy, fz] = request.forward;
  for (let i = 0, k = 0; i < keys.length; ++i, k += 3) {
    const x = positions[k] - cx, y = positions[k + 1] - cy, z = positions[k + 2] - cz;
    const along = fx * x + fy * y + fz * z;
    values[i] = request.byDistance ? Math.sqrt(x * x + y * y + z * z) : along > 0 ? along : 0;
  }
  /* From far to near. */
  for (let i = 0; i < keys.length; ++i) keys[i] = ~keys[i];
  const order = request.order && request.order.length === keys.length ? request.order : new Uint32Array(keys.length);
  countingSort(null, first, 0);
  countingSort(first, order, 16);
  postMessage({order, number: request.number}, [order.buffer]);
};
