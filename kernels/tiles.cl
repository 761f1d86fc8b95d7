/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Pairs of (Gaussian, tile). A pair's slot is its place in order of Gaussians, then tiles: there its gradients are kept.
   Result, for every tile: list[p], p in tile_start[tile] .. tile_start[tile + 1]: Gaussians from near to far, and
   slot[p]. All of it is integers in an order given by the data, so it does not depend on threads or chunks.
   Tile test: the span of the ellipse over a row of tiles (Hanson et al. 2024). count_tiles and emit_pairs must find the
   same tiles to the bit: nothing in row_span leaves the compiler a choice of rounding (explicit fma, no other a * b + c). */

/* Tiles of the tile row `row` that the ellipse reaches with a pixel centre: first and one past the last. */
inline int2 row_span(float8 box, int row, int4 size) {
  const float y0 = (float)(row * TILE_HEIGHT) - box.s1;
  const float y1 = (float)min(row * TILE_HEIGHT + TILE_HEIGHT - 1, size.y - 1) - box.s1;
  const float right_y = min(max(box.s7, y0), y1);
  const float left_y = min(max(-box.s7, y0), y1);
  const float right = box.s0 + fma(box.s4, right_y, sqrt(max(fma(-box.s6, right_y * right_y, box.s5), 0.0f)));
  const float left = box.s0 + fma(box.s4, left_y, -sqrt(max(fma(-box.s6, left_y * left_y, box.s5), 0.0f)));
  const int x0 = max(int_ceil(max(left, -1.0f)), 0);
  const int x1 = min(int_floor(min(right, (float)size.x)), size.x - 1);
  return x0 > x1 || x1 < 0 ? (int2)(0, 0) : (int2)(x0 / TILE_WIDTH, x1 / TILE_WIDTH + 1);
}

/* Rows of tiles that the box reaches: first and one past the last. */
inline int2 row_range(float8 box, int4 size) {
  const int y0 = max(int_ceil(max(box.s1 - box.s3, -1.0f)), 0);
  const int y1 = min(int_floor(min(box.s1 + box.s3, (float)size.y)), size.y - 1);
  return y0 > y1 || y1 < 0 ? (int2)(0, 0) : (int2)(y0 / TILE_HEIGHT, y1 / TILE_HEIGHT + 1);
}

/* size: width, height, tiles a row, rows of tiles. */
kernel void count_tiles(int n, global const float8* restrict boxes, global const uint* restrict depth_keys, int4 size,
                        global uint* restrict counts) {
  const int g = get_global_id(0);
  if (g >= n) return;
  uint count = 0;
  if (depth_keys[g] != 0xffffffffu) {
    const float8 box = boxes[g];
    const int2 rows = row_range(box, size);
    for (int row = rows.x; row < rows.y; ++row) {
      const int2 span = row_span(box, row, size);
      count += (uint)(span.y - span.x);
    }
  }
  counts[g] = count;
}

/* One item a Gaussian: its tiles into the slots offsets[g] .. offsets[g + 1]. */
kernel void emit_pairs(int n, global const float8* restrict boxes, global const uint* restrict offsets, int4 size,
                       global uint* restrict slot_tile) {
  const int g = get_global_id(0);
  if (g >= n) return;
  uint e = offsets[g];
  const uint end = offsets[g + 1];
  if (e == end) return;
  const float8 box = boxes[g];
  const int2 rows = row_range(box, size);
  for (int row = rows.x; row < rows.y; ++row) {
    const int2 span = row_span(box, row, size);
    for (int tile = span.x; tile < span.y && e < end; ++tile, ++e) slot_tile[e] = (uint)(row * size.z + tile);
  }
}

/* For CPUs, few long chunks: a stable counting sort by tile, one item a chunk of Gaussians consecutive in depth. */
kernel __attribute__((reqd_work_group_size(1, 1, 1))) void bin_histogram(
    int n, int chunk_size, int tiles, global const uint* restrict order, global const uint* restrict offsets,
    global const uint* restrict slot_tile, global uint* restrict histogram) {
  const int chunk = get_global_id(0);
  global uint* row = histogram + (size_t)chunk * (size_t)tiles;
  for (int t = 0; t < tiles; ++t) row[t] = 0;
  const int end = min(n, (chunk + 1) * chunk_size);
  for (int r = chunk * chunk_size; r < end; ++r) {
    const uint g = order[r], last = offsets[g + 1];
    for (uint e = offsets[g]; e < last; ++e) ++row[slot_tile[e]];
  }
}

kernel void bin_totals(int tiles, int chunks, global const uint* restrict histogram, global uint* restrict totals) {
  const int t = get_global_id(0);
  if (t >= tiles) return;
  uint sum = 0;
  for (int chunk = 0; chunk < chunks; ++chunk) sum += histogram[(size_t)chunk * (size_t)tiles + t];
  totals[t] = sum;
}

kernel void bin_cursors(int tiles, int chunks, global const uint* restrict tile_start,
                        global uint* restrict histogram) {
  const int t = get_global_id(0);
  if (t >= tiles) return;
  uint cursor = tile_start[t];
  for (int chunk = 0; chunk < chunks; ++chunk) {
    const size_t at = (size_t)chunk * (size_t)tiles + t;
    const uint count = histogram[at];
    histogram[at] = cursor;
    cursor += count;
  }
}

kernel __attribute__((reqd_work_group_size(1, 1, 1))) void bin_scatter(
    int n, int chunk_size, int tiles, global const uint* restrict order, global const uint* restrict offsets,
    global const uint* restrict slot_tile, global uint* restrict cursors, global uint* restrict list,
    global uint* restrict slot) {
  const int chunk = get_global_id(0);
  global uint* cursor = cursors + (size_t)chunk * (size_t)tiles;
  const int end = min(n, (chunk + 1) * chunk_size);
  for (int r = chunk * chunk_size; r < end; ++r) {
    const uint g = order[r], last = offsets[g + 1];
    for (uint e = offsets[g]; e < last; ++e) {
      const uint p = cursor[slot_tile[e]]++;
      list[p] = g;
      slot[p] = e;
    }
  }
}

/* For GPUs, many items: the pairs in order of depth, a stable radix sort of their tiles (`sorted`: place by rank), and
   the lists from that. */
kernel void gather_counts(int n, global const uint* restrict order, global const uint* restrict counts,
                          global uint* restrict depth_counts) {
  const int r = get_global_id(0);
  if (r < n) depth_counts[r] = counts[order[r]];
}

kernel void order_pairs(int n, global const uint* restrict order, global const uint* restrict offsets,
                        global const uint* restrict depth_offsets, global const uint* restrict slot_tile,
                        global uint* restrict depth_tile, global uint2* restrict depth_pair) {
  const int r = get_global_id(0);
  if (r >= n) return;
  const uint g = order[r], last = offsets[g + 1];
  uint to = depth_offsets[r];
  for (uint e = offsets[g]; e < last; ++e, ++to) {
    depth_tile[to] = slot_tile[e];
    depth_pair[to] = (uint2)(g, e);
  }
}

kernel void gather_pairs(uint pairs, int tiles, global const uint* restrict sorted,
                         global const uint* restrict depth_tile, global const uint2* restrict depth_pair,
                         global uint* restrict list, global uint* restrict slot, global uint* restrict tile_start) {
  const uint p = (uint)get_global_id(0);
  if (p >= pairs) return;
  const uint from = sorted[p];
  list[p] = depth_pair[from].x;
  slot[p] = depth_pair[from].y;
  const int tile = (int)depth_tile[from];
  const int previous = p == 0 ? -1 : (int)depth_tile[sorted[p - 1]];
  for (int t = previous + 1; t <= tile; ++t) tile_start[t] = p;
  if (p == pairs - 1) {
    for (int t = tile + 1; t <= tiles; ++t) tile_start[t] = pairs;
  }
}
