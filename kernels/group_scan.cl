/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Prefix sums by groups of SCAN_GROUP items, for GPUs; scan.cl does the same over long chunks, for CPUs. The sums are
   of integers, so both results are equal. */

/* Returns the sum of `value` over the items before this one; *total is the sum over the group. All items of the group
   must call it; `shared` has SCAN_GROUP elements and may be used again after the next barrier. */
static inline uint group_scan(uint value, local uint* shared, uint* total) {
  const uint lane = (uint)get_local_id(0);
  uint sum = value;
  shared[lane] = sum;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint step = 1; step < SCAN_GROUP; step *= 2) {
    const uint before = lane >= step ? shared[lane - step] : 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    sum += before;
    shared[lane] = sum;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  *total = shared[SCAN_GROUP - 1];
  return sum - value;
}

/* sums[b]: sum of block b of SCAN_BLOCK values. One group per block. */
kernel __attribute__((reqd_work_group_size(SCAN_GROUP, 1, 1))) void group_scan_sums(
    global const uint* restrict values, global uint* restrict sums, uint n) {
  local uint shared[SCAN_GROUP];
  const uint lane = (uint)get_local_id(0), block = (uint)get_group_id(0);
  const uint begin = block * SCAN_BLOCK, end = min(n, begin + SCAN_BLOCK);
  uint sum = 0;
  for (uint i = begin + lane; i < end; i += SCAN_GROUP) sum += values[i];
  uint total;
  group_scan(sum, shared, &total);
  if (lane == 0) sums[block] = total;
}

/* Replaces the blocks' sums by their exclusive prefix sums; out[n] is the total. A single group. */
kernel __attribute__((reqd_work_group_size(SCAN_GROUP, 1, 1))) void group_scan_starts(
    global uint* restrict sums, global uint* restrict out, uint blocks, uint n) {
  local uint shared[SCAN_GROUP];
  const uint lane = (uint)get_local_id(0);
  uint carry = 0;
  for (uint base = 0; base < blocks; base += SCAN_GROUP) {
    const uint i = base + lane;
    uint total;
    const uint before = group_scan(i < blocks ? sums[i] : 0u, shared, &total);
    if (i < blocks) sums[i] = carry + before;
    carry += total;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  if (lane == 0) out[n] = carry;
}

/* Each item scans four consecutive values. */
kernel __attribute__((reqd_work_group_size(SCAN_GROUP, 1, 1))) void group_scan_write(
    global const uint* restrict values, global const uint* restrict starts, global uint* restrict out, uint n) {
  local uint shared[SCAN_GROUP];
  const uint block = (uint)get_group_id(0);
  const uint first = block * SCAN_BLOCK + 4u * (uint)get_local_id(0);
  const uint v0 = first < n ? values[first] : 0u, v1 = first + 1 < n ? values[first + 1] : 0u;
  const uint v2 = first + 2 < n ? values[first + 2] : 0u, v3 = first + 3 < n ? values[first + 3] : 0u;
  uint total;
  const uint start = starts[block] + group_scan(v0 + v1 + v2 + v3, shared, &total);
  if (first < n) out[first] = start;
  if (first + 1 < n) out[first + 1] = start + v0;
  if (first + 2 < n) out[first + 2] = start + v0 + v1;
  if (first + 3 < n) out[first + 3] = start + v0 + v1 + v2;
}
