/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Runs in a worker: the Gaussians that a view may show, from far to near by the depth of their centres along the optical
   axis or by their distance, as the map's colours were trained. The keys are the bits of positive floats, which ascend
   with the value; two stable counting sorts of 16 bits each. */

let positions = new Float32Array(0);
let reaches = new Float32Array(0); /* how far from its centre a Gaussian is seen, at most [m] */
let keys = new Uint32Array(0);
let shown = new Uint32Array(0);
let first = new Uint32Array(0);
const starts = new Uint32Array(65537);

/* Appends each of the n indices of `from` to the bucket of its key's digit. */
function countingSort(from, to, n, shift) {
  starts.fill(0);
  for (let i = 0; i < n; ++i) ++starts[(keys[from[i]] >>> shift & 65535) + 1];
  for (let d = 0; d < 65536; ++d) starts[d + 1] += starts[d];
  for (let i = 0; i < n; ++i) to[starts[keys[from[i]] >>> shift & 65535]++] = from[i];
}

/* Keys and indices of the Gaussians in front of the camera whose splat can reach into the image: limits: least and
   largest x/z, least and largest y/z; stretch: of a splat against its reach over its depth, at most. */
function select({centre: [cx, cy, cz], rotation: r, limits: [left, right, above, below], stretch, byDistance}) {
  const values = new Float32Array(keys.buffer);
  let n = 0;
  /* From the last to the first, so that equal keys come in the opposite of the order in which the map has them. */
  for (let i = keys.length - 1; i >= 0; --i) {
    const dx = positions[3 * i] - cx, dy = positions[3 * i + 1] - cy, dz = positions[3 * i + 2] - cz;
    const z = r[6] * dx + r[7] * dy + r[8] * dz;
    if (!(z > 0.04)) continue;
    const x = r[0] * dx + r[1] * dy + r[2] * dz, y = r[3] * dx + r[4] * dy + r[5] * dz, reach = stretch * reaches[i];
    if (x > z * right + reach || x < z * left - reach || y > z * below + reach || y < z * above - reach) continue;
    values[i] = byDistance ? Math.sqrt(dx * dx + dy * dy + dz * dz) : z;
    keys[i] = ~keys[i]; /* from far to near */
    shown[n++] = i;
  }
  return n;
}

onmessage = (event) => {
  const request = event.data;
  if (request.positions) {
    ({positions, reaches} = request);
    keys = new Uint32Array(reaches.length);
    shown = new Uint32Array(reaches.length);
    first = new Uint32Array(reaches.length);
    return;
  }
  const n = select(request), order = request.order ? new Uint32Array(request.order) : new Uint32Array(keys.length);
  countingSort(shown, first, n, 0);
  countingSort(first, order, n, 16);
  postMessage({order: order.buffer, count: n}, [order.buffer]);
};
