/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Gaussians as the page carries them: packed_map.hpp in the repository says how. */

class PackedMap {
  constructor(buffer, facts) {
    this.count = facts.count;
    this.chunk = facts.chunk;
    this.coefficients = (facts.degree + 1) ** 2;
    this.channels = 6 + 3 * this.coefficients;
    const n = this.count, chunks = Math.ceil(n / this.chunk);
    let at = 0;
    this.ranges = new Float32Array(buffer, at, 2 * chunks * this.channels);
    at += this.ranges.byteLength;
    this.rotations = new Uint32Array(buffer, at, n);
    at += 4 * n;
    this.places = new Uint16Array(buffer, at, 3 * n);
    at += 6 * n;
    this.sizes = new Uint8Array(buffer, at, 3 * n);
    at += 3 * n;
    this.colors = new Uint8Array(buffer, at, 3 * this.coefficients * n);
    at += this.colors.byteLength;
    this.opacities = new Uint8Array(buffer, at, n);
  }

  /* Value of a channel of Gaussian i from its stored share 0..1. */
  value(i, channel, share) {
    const r = 2 * (Math.floor(i / this.chunk) * this.channels + channel);
    return this.ranges[r] + (this.ranges[r + 1] - this.ranges[r]) * share;
  }

  /* x y z of all Gaussians [m, world]. */
  positions() {
    const result = new Float32Array(3 * this.count);
    for (let i = 0; i < this.count; ++i) {
      for (let c = 0; c < 3; ++c) result[3 * i + c] = this.value(i, c, this.places[c * this.count + i] / 65535);
    }
    return result;
  }

  /* How far from its centre each Gaussian is seen, at most [m]: alpha falls to 1/255 within 3.34 deviations. */
  reaches() {
    const result = new Float32Array(this.count);
    for (let i = 0; i < this.count; ++i) {
      let largest = -Infinity;
      for (let c = 0; c < 3; ++c) largest = Math.max(largest, this.value(i, 3 + c, this.sizes[c * this.count + i] / 255));
      result[i] = 3.34 * Math.exp(largest);
    }
    return result;
  }

  /* Twelve numbers of Gaussian i: x y z, log2 of the opacity; quaternion x y z w; standard deviations [m], 0. */
  shape(i, to, at) {
    for (let c = 0; c < 3; ++c) {
      to[at + c] = this.value(i, c, this.places[c * this.count + i] / 65535);
      to[at + 8 + c] = Math.exp(this.value(i, 3 + c, this.sizes[c * this.count + i] / 255));
    }
    to[at + 3] = Math.log2(Math.max(this.opacities[i], 0.5) / 255);
    const bits = this.rotations[i], largest = bits >>> 30, wxyz = [0, 0, 0, 0];
    let rest = 1, shift = 0;
    for (let k = 0; k < 4; ++k) {
      if (k === largest) continue;
      wxyz[k] = ((bits >>> shift & 1023) / 1023 * 2 - 1) * Math.SQRT1_2;
      rest -= wxyz[k] * wxyz[k];
      shift += 10;
    }
    wxyz[largest] = Math.sqrt(Math.max(rest, 0));
    to[at + 4] = wxyz[1];
    to[at + 5] = wxyz[2];
    to[at + 6] = wxyz[3];
    to[at + 7] = wxyz[0];
    to[at + 11] = 0;
  }

  /* Coefficients of Gaussian i, R G B and 0 of each. */
  color(i, to, at) {
    for (let k = 0; k < this.coefficients; ++k) {
      for (let c = 0; c < 3; ++c) {
        const channel = 3 * k + c;
        to[at + 4 * k + c] = this.value(i, 6 + channel, this.colors[channel * this.count + i] / 255);
      }
      to[at + 4 * k + 3] = 0;
    }
  }
}
