/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Pairs of (Gaussian, tile): counted, written in order of depth, then brought into lists a tile.
   Result, for every tile: list[p], p in tile_start[tile] .. tile_start[tile + 1]: Gaussians from near to far, and
   slot[p]: the pair's place in order of Gaussians, where its gradients are summed. All of it is integers in an order
   given by the data, so it does not depend on threads or chunks.
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

kernel void gather_counts(int n, global const uint* restrict order, global const uint* restrict counts,
                          global uint* restrict ordered) {
  const int r = get_global_id(0);
  if (r < n) ordered[r] = counts[order[r]];
}

/* One item a rank in depth. first_pair[g]: where the pairs of Gaussian g begin. */
kernel void emit_pairs(int n, global const uint* restrict order, global const float8* restrict boxes,
                       global const uint* restrict offsets, int4 size, global uint* restrict first_pair,
                       global uint* restrict pair_tile, global uint* restrict pair_owner) {
  const int r = get_global_id(0);
  if (r >= n) return;
  const uint g = order[r];
  uint e = offsets[r];
  const uint end = offsets[r + 1];
  first_pair[g] = e;
  if (e == end) return;
  const float8 box = boxes[g];
  const int2 rows = row_range(box, size);
  for (int row = rows.x; row < rows.y; ++row) {
    const int2 span = row_span(box, row, size);
    for (int tile = span.x; tile < span.y && e < end; ++tile, ++e) {
      pair_tile[e] = (uint)(row * size.z + tile);
      pair_owner[e] = g;
    }
  }
}

/* Few long chunks, for CPUs: a stable counting sort by tile, one item a chunk of consecutive pairs. */
kernel __attribute__((reqd_work_group_size(1, 1, 1))) void bin_histogram(uint pairs, uint chunk_size, int tiles,
                                                                         global const uint* restrict pair_tile,
                                                                         global uint* restrict histogram) {
  const uint chunk = (uint)get_global_id(0);
  global uint* row = histogram + chunk * (uint)tiles;
  for (int t = 0; t < tiles; ++t) row[t] = 0;
  const uint end = min(pairs, (chunk + 1) * chunk_size);
  for (uint e = chunk * chunk_size; e < end; ++e) ++row[pair_tile[e]];
}

kernel void bin_totals(int tiles, int chunks, global const uint* restrict histogram, global uint* restrict totals) {
  const int t = get_global_id(0);
  if (t >= tiles) return;
  uint sum = 0;
  for (int chunk = 0; chunk < chunks; ++chunk) sum += histogram[chunk * tiles + t];
  totals[t] = sum;
}

kernel void bin_cursors(int tiles, int chunks, global const uint* restrict tile_start,
                        global uint* restrict histogram) {
  const int t = get_global_id(0);
  if (t >= tiles) return;
  uint cursor = tile_start[t];
  for (int chunk = 0; chunk < chunks; ++chunk) {
    const uint count = histogram[chunk * tiles + t];
    histogram[chunk * tiles + t] = cursor;
    cursor += count;
  }
}

kernel __attribute__((reqd_work_group_size(1, 1, 1))) void bin_scatter(
    uint pairs, uint chunk_size, int tiles, global const uint* restrict pair_tile,
    global const uint* restrict pair_owner, global uint* restrict cursors, global uint* restrict list,
    global uint* restrict slot) {
  const uint chunk = (uint)get_global_id(0);
  global uint* cursor = cursors + chunk * (uint)tiles;
  const uint end = min(pairs, (chunk + 1) * chunk_size);
  for (uint e = chunk * chunk_size; e < end; ++e) {
    const uint p = cursor[pair_tile[e]]++;
    list[p] = pair_owner[e];
    slot[p] = e;
  }
}

/* Many items, for GPUs: after a stable radix sort of pair_tile, whose order is `slot`. */
kernel void gather_pairs(uint pairs, int tiles, global const uint* restrict slot,
                         global const uint* restrict pair_tile, global const uint* restrict pair_owner,
                         global uint* restrict list, global uint* restrict tile_start) {
  const uint p = (uint)get_global_id(0);
  if (p >= pairs) return;
  const uint e = slot[p];
  list[p] = pair_owner[e];
  const int tile = (int)pair_tile[e];
  const int previous = p == 0 ? -1 : (int)pair_tile[slot[p - 1]];
  for (int t = previous + 1; t <= tile; ++t) tile_start[t] = p;
  if (p == pairs - 1) {
    for (int t = tile + 1; t <= tiles; ++t) tile_start[t] = pairs;
  }
}
