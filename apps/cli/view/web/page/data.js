/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   The page's data: JSON and two blocks, compressed by zlib, in base64 (written by web_page.cpp and its neighbours in the
   repository). */

async function readBlock(id) {
  if (!window.DecompressionStream) throw new Error('This browser is too old for this page (before 2023).');
  const text = atob(document.getElementById(id).textContent.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

/* The JSON, in which every {at, count} is replaced by that part of the block of numbers; NaN stands for "none". */
async function readData() {
  const data = JSON.parse(document.getElementById('data').textContent);
  const numbers = new Float32Array(await readBlock('numbers'));
  const resolved = (value) => {
    if (value === null || typeof value !== 'object') return value;
    if ('at' in value && 'count' in value) return numbers.subarray(value.at, value.at + value.count);
    for (const key of Object.keys(value)) value[key] = resolved(value[key]);
    return value;
  };
  for (const key of ['times', 'runs', 'truth']) data[key] = resolved(data[key]);
  return data;
}

/* Pose of a frame: {t: [x, y, z], q: [x, y, z, w]}, camera to world; null if there is none. */
function poseAt(poses, frame) {
  const p = poses.subarray(7 * frame, 7 * frame + 7);
  return p.length === 7 && Number.isFinite(p[0]) ? {t: [p[0], p[1], p[2]], q: [p[3], p[4], p[5], p[6]]} : null;
}
