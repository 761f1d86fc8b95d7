// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Exclusive prefix sum in three steps: sums of chunks, scan of the sums, scan of each chunk from its start.
// One work-item per chunk: on a CPU a long chunk is limited by memory bandwidth only.

__kernel void scan_chunk_sums(__global const uint* restrict values, __global uint* restrict sums, uint n, uint chunk) {
  const uint c = (uint)get_global_id(0);
  const uint begin = c * chunk;
  if (begin >= n) return;
  const uint end = min(n, begin + chunk);
  uint sum = 0;
  for (uint i = begin; i < end; ++i) sum += values[i];
  sums[c] = sum;
}

// A single work-item, as there are few chunks.
__kernel void scan_sums(__global uint* restrict sums, __global uint* restrict out, uint chunks, uint n) {
  if (get_global_id(0) != 0) return;
  uint sum = 0;
  for (uint c = 0; c < chunks; ++c) {
    const uint s = sums[c];
    sums[c] = sum;
    sum += s;
  }
  out[n] = sum;
}

__kernel void scan_write(__global const uint* restrict values, __global const uint* restrict sums,
                         __global uint* restrict out, uint n, uint chunk) {
  const uint c = (uint)get_global_id(0);
  const uint begin = c * chunk;
  if (begin >= n) return;
  const uint end = min(n, begin + chunk);
  uint sum = sums[c];
  for (uint i = begin; i < end; ++i) {
    out[i] = sum;
    sum += values[i];
  }
}
