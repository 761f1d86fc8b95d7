// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// One pass of a stable radix sort of indices by 32-bit keys. Chunks are contiguous parts of the input, one per
// work-item. The result of a stable sort is unique, so the number of chunks affects only the speed.

// `first` != 0: the input order is 0, 1, 2, ... and is not read.
static inline uint radix_index(__global const uint* restrict order, uint i, int first) {
  return first ? i : order[i];
}

__kernel void radix_histogram(__global const uint* restrict keys, __global const uint* restrict order,
                              __global uint* restrict counts, uint n, uint chunk, uint chunks, uint shift, int first) {
  const uint c = (uint)get_global_id(0);
  if (c >= chunks) return;
  __global uint* mine = counts + c * RADIX_SIZE;
  for (uint d = 0; d < RADIX_SIZE; ++d) mine[d] = 0;
  const uint end = min(n, (c + 1) * chunk);
  for (uint i = c * chunk; i < end; ++i) ++mine[(keys[radix_index(order, i, first)] >> shift) & (RADIX_SIZE - 1)];
}

// One work-item per digit: replaces each chunk's count by its start among the keys of this digit; totals: their number.
__kernel void radix_chunk_offsets(__global uint* restrict counts, __global uint* restrict totals, uint chunks) {
  const uint d = (uint)get_global_id(0);
  if (d >= RADIX_SIZE) return;
  uint sum = 0;
  for (uint c = 0; c < chunks; ++c) {
    const uint count = counts[c * RADIX_SIZE + d];
    counts[c * RADIX_SIZE + d] = sum;
    sum += count;
  }
  totals[d] = sum;
}

// A single work-item: replaces the totals by their exclusive prefix sums.
__kernel void radix_digit_offsets(__global uint* restrict totals) {
  if (get_global_id(0) != 0) return;
  uint sum = 0;
  for (uint d = 0; d < RADIX_SIZE; ++d) {
    const uint total = totals[d];
    totals[d] = sum;
    sum += total;
  }
}

// Uses a chunk's row of counts as its write positions within each digit, which needs no private table.
__kernel void radix_scatter(__global const uint* restrict keys, __global const uint* restrict order,
                            __global uint* restrict counts, __global const uint* restrict totals,
                            __global uint* restrict out, uint n, uint chunk, uint chunks, uint shift, int first) {
  const uint c = (uint)get_global_id(0);
  if (c >= chunks) return;
  __global uint* mine = counts + c * RADIX_SIZE;
  const uint end = min(n, (c + 1) * chunk);
  for (uint i = c * chunk; i < end; ++i) {
    const uint index = radix_index(order, i, first);
    const uint d = (keys[index] >> shift) & (RADIX_SIZE - 1);
    out[totals[d] + mine[d]++] = index;
  }
}
