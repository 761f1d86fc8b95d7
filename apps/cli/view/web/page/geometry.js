/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Vectors [x, y, z] and views. Camera: x right, y down, z forward; pixel (0, 0) is the centre of the upper left pixel. */

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (s, a) => [s * a[0], s * a[1], s * a[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const norm = (a) => Math.sqrt(dot(a, a));
const unit = (a) => times(1 / norm(a), a);
const limited = (value, low, high) => Math.min(Math.max(value, low), high);

/* Columns of the rotation of a quaternion x y z w: the camera's axes in the world. */
function axesOf([x, y, z, w]) {
  return [[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
          [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
          [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]];
}

/* The axes are the rows of world to camera. */
const rowsOf = (axes) => [...axes[0], ...axes[1], ...axes[2]];

function rotated([x, y, z, w], v) {
  const [a, b, c] = axesOf([x, y, z, w]);
  return [a[0] * v[0] + b[0] * v[1] + c[0] * v[2], a[1] * v[0] + b[1] * v[1] + c[1] * v[2],
          a[2] * v[0] + b[2] * v[1] + c[2] * v[2]];
}

/* The true position in the estimate's world. align: brings the estimate to the truth (p' = scale R p + t). */
function unaligned(align, p) {
  if (!align) return p;
  const [tx, ty, tz, x, y, z, w] = align.pose;
  return times(1 / align.scale, rotated([-x, -y, -z, w], sub(p, [tx, ty, tz])));
}

function productOf([ax, ay, az, aw], [bx, by, bz, bw]) {
  return [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
          aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz];
}

function unalignedPose(align, pose) {
  if (!align || !pose) return pose;
  const [, , , x, y, z, w] = align.pose;
  return {t: unaligned(align, pose.t), q: productOf([-x, -y, -z, w], pose.q)};
}

/* A camera's view at another size: {fx, fy, cx, cy, width, height} [px]. */
function resizedLens(camera, width, height) {
  const sx = width / camera.width, sy = height / camera.height;
  return {fx: sx * camera.fx, fy: sy * camera.fy, cx: sx * (camera.cx + 0.5) - 0.5, cy: sy * (camera.cy + 0.5) - 0.5,
          width, height};
}

/* A point of the world in camera coordinates. */
function toCamera(view, p) {
  const r = view.rotation, d = sub(p, view.centre);
  return [r[0] * d[0] + r[1] * d[1] + r[2] * d[2], r[3] * d[0] + r[4] * d[1] + r[5] * d[2],
          r[6] * d[0] + r[7] * d[1] + r[8] * d[2]];
}

/* The largest rectangle of a camera's shape in the middle of another, whole pixels. */
function fittedRect(camera, outer) {
  const scale = Math.min(outer.width / camera.width, outer.height / camera.height);
  const width = Math.max(1, Math.round(scale * camera.width)), height = Math.max(1, Math.round(scale * camera.height));
  return {x: outer.x + Math.floor((outer.width - width) / 2), y: outer.y + Math.floor((outer.height - height) / 2),
          width, height};
}

/* Place and extent of a map: middle, radius and upward axis, from its central 96 %. */
function extentOf(positions, up) {
  const n = positions.length / 3, step = Math.max(1, Math.floor(n / 20000)), low = [], high = [];
  for (let c = 0; c < 3; ++c) {
    const values = [];
    for (let i = 0; i < n; i += step) values.push(positions[3 * i + c]);
    values.sort((a, b) => a - b);
    low.push(values[Math.floor(0.02 * (values.length - 1))]);
    high.push(values[Math.ceil(0.98 * (values.length - 1))]);
  }
  const size = sub(high, low), vertical = size.indexOf(Math.min(...size));
  const axis = up || [[1, 0, 0], [0, -1, 0], [0, 0, 1]][vertical];
  const middle = times(0.5, add(low, high)), half = times(0.5, size);
  const reach = Math.abs(axis[0]) * half[0] + Math.abs(axis[1]) * half[1] + Math.abs(axis[2]) * half[2];
  return {middle, radius: Math.max(0.5 * norm(size), 1e-3), up: axis, floor: dot(axis, middle) - reach,
          ceiling: dot(axis, middle) + reach};
}
