/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   One pass of a stable radix sort of indices by 32-bit keys over groups, for GPUs; compiled after group_scan.cl. A
   group sorts RADIX_GROUP_KEYS consecutive places of the order, an item RADIX_ITEM_KEYS consecutive ones of these.
   radix_sort.cl does the same over long chunks, for CPUs; the result of a stable sort is unique, so both agree.
   counts, digit by digit: [RADIX_DIGITS x groups]; their exclusive scan gives where each group writes each digit. */

/* `first` != 0: the input order is 0, 1, 2, ... and is not read. */
static inline uint group_radix_index(global const uint* restrict order, uint i, int first) {
  return first ? i : order[i];
}

kernel __attribute__((reqd_work_group_size(SCAN_GROUP, 1, 1))) void group_radix_histogram(
    global const uint* restrict keys, global const uint* restrict order, global uint* restrict counts, uint n,
    uint shift, int first) {
  local uint digits[RADIX_DIGITS];
  const uint lane = (uint)get_local_id(0), group = (uint)get_group_id(0), groups = (uint)get_num_groups(0);
  if (lane < RADIX_DIGITS) digits[lane] = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint begin = group * RADIX_GROUP_KEYS, end = min(n, begin + RADIX_GROUP_KEYS);
  for (uint i = begin + lane; i < end; i += SCAN_GROUP) {
    atomic_inc(&digits[(keys[group_radix_index(order, i, first)] >> shift) & (RADIX_DIGITS - 1)]);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (lane < RADIX_DIGITS) counts[lane * groups + group] = digits[lane];
}

kernel __attribute__((reqd_work_group_size(SCAN_GROUP, 1, 1))) void group_radix_scatter(
    global const uint* restrict keys, global const uint* restrict order, global const uint* restrict starts,
    global uint* restrict out, uint n, uint shift, int first) {
  /* For each digit and item: first the number of its keys, then the place in the group of its next key. */
  local ushort place[RADIX_DIGITS][SCAN_GROUP];
  local uint shared[SCAN_GROUP];
  local uint base[RADIX_DIGITS];
  const uint lane = (uint)get_local_id(0), group = (uint)get_group_id(0), groups = (uint)get_num_groups(0);
  for (uint d = 0; d < RADIX_DIGITS; ++d) place[d][lane] = 0;
  const uint begin = group * RADIX_GROUP_KEYS + lane * RADIX_ITEM_KEYS;
  const uint end = min(n, begin + RADIX_ITEM_KEYS);
  for (uint i = begin; i < end; ++i) {
    ++place[(keys[group_radix_index(order, i, first)] >> shift) & (RADIX_DIGITS - 1)][lane];
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  /* Scan of the table, digit by digit: each item scans RADIX_DIGITS consecutive entries of one digit's row. */
  const uint row = lane / (SCAN_GROUP / RADIX_DIGITS);
  const uint column = (lane % (SCAN_GROUP / RADIX_DIGITS)) * RADIX_DIGITS;
  uint sum = 0;
  for (uint k = 0; k < RADIX_DIGITS; ++k) sum += place[row][column + k];
  uint total;
  uint at = group_scan(sum, shared, &total);
  for (uint k = 0; k < RADIX_DIGITS; ++k) {
    const uint count = place[row][column + k];
    place[row][column + k] = (ushort)at;
    at += count;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (lane < RADIX_DIGITS) base[lane] = starts[lane * groups + group] - place[lane][0];
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = begin; i < end; ++i) {
    const uint index = group_radix_index(order, i, first);
    const uint d = (keys[index] >> shift) & (RADIX_DIGITS - 1);
    out[base[d] + place[d][lane]++] = index;
  }
}
