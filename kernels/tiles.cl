/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Pairs of (Gaussian, tile). Compiled after projection.cl, whose vectors of GW Gaussians it uses. A pair's slot, which
   stores its gradients, is its place in the order of Gaussians, then of tiles.
   Result, for every tile: list[p], p in tile_start[tile] .. tile_start[tile + 1]: Gaussians from near to far, and
   slot[p]. All results are integers in an order given by the data, so they do not depend on threads or chunks.
   Tile test: the span of the ellipse over a row of tiles (Hanson et al. 2024). count_tiles and emit_pairs must find
   exactly the same tiles, so row_range and row_span leave the compiler no choice of rounding (explicit fma, no other
   a * b + c). */

/* The ellipses of GW Gaussians: centre, half sizes; at offset y from the centre the ellipse spans
   x = shear y +- sqrt(w0 - w1 y^2), and its rightmost point is at y = tilt. In memory field by field, GW values
   each. */
typedef struct {
  gF u, v, half_x, half_y, shear, w0, w1, tilt;
} Ellipse;

inline void store_ellipse(global float* restrict boxes, int item, const Ellipse* e) {
  global float* to = boxes + (size_t)item * (8 * GW);
  STORE_LANES(e->u, to);
  STORE_LANES(e->v, to + GW);
  STORE_LANES(e->half_x, to + 2 * GW);
  STORE_LANES(e->half_y, to + 3 * GW);
  STORE_LANES(e->shear, to + 4 * GW);
  STORE_LANES(e->w0, to + 5 * GW);
  STORE_LANES(e->w1, to + 6 * GW);
  STORE_LANES(e->tilt, to + 7 * GW);
}
inline Ellipse load_ellipse(global const float* restrict boxes, int item) {
  global const float* from = boxes + (size_t)item * (8 * GW);
  Ellipse e;
  e.u = LOAD_LANES(from);
  e.v = LOAD_LANES(from + GW);
  e.half_x = LOAD_LANES(from + 2 * GW);
  e.half_y = LOAD_LANES(from + 3 * GW);
  e.shear = LOAD_LANES(from + 4 * GW);
  e.w0 = LOAD_LANES(from + 5 * GW);
  e.w1 = LOAD_LANES(from + 6 * GW);
  e.tilt = LOAD_LANES(from + 7 * GW);
  return e;
}

inline gI floor_g(gF x) {
  const gI t = to_gI(x);
  return t + GMASK(x < CONVERT_GF(t));
}
inline gI ceil_g(gF x) {
  const gI t = to_gI(x);
  return t - GMASK(x > CONVERT_GF(t));
}

/* Rows of pixels that each ellipse reaches: returns the first; *last is smaller if there are none. */
inline gI row_range(const Ellipse* e, int4 size, gI* last) {
  *last = min(floor_g(min(e->v + e->half_y, (float)size.y)), size.y - 1);
  return max(ceil_g(max(e->v - e->half_y, -1.0f)), 0);
}

/* Columns of pixels whose centres each ellipse contains within its row of tiles `row`: returns the first and sets
   *last. */
inline gI row_span(const Ellipse* e, gI row, int4 size, gI* last) {
  const gF y0 = CONVERT_GF(row * TILE_HEIGHT) - e->v;
  const gF y1 = CONVERT_GF(min(row * TILE_HEIGHT + (TILE_HEIGHT - 1), size.y - 1)) - e->v;
  const gF right_y = min(max(e->tilt, y0), y1);
  const gF left_y = min(max(-e->tilt, y0), y1);
  const gF right = e->u + fma(e->shear, right_y, sqrt(max(fma(-e->w1, right_y * right_y, e->w0), 0.0f)));
  const gF left = e->u + fma(e->shear, left_y, -sqrt(max(fma(-e->w1, left_y * left_y, e->w0), 0.0f)));
  *last = min(floor_g(min(right, (float)size.x)), size.x - 1);
  return max(ceil_g(max(left, -1.0f)), 0);
}

/* Tiles that are rendered: if `sparse`, those with bits in `wanted` (blocks of 4 x 4 pixels, as in composite.cl). */
#define WANTED_ARGUMENTS int sparse, global const uint *restrict wanted
#define WANTED sparse, wanted

/* Whether a Gaussian with pixels x0..x1, y0..y1 reaches a wanted block of the tile. */
inline int is_wanted(int column, int row, int x0, int x1, int y0, int y1, int4 size, WANTED_ARGUMENTS) {
  if (!sparse) return 1;
  const int tile_x = column * TILE_WIDTH, tile_y = row * TILE_HEIGHT;
  const uint left = (uint)max(x0 - tile_x, 0) / 4, right = (uint)min(x1 - tile_x, TILE_WIDTH - 1) / 4;
  const uint top = (uint)max(y0 - tile_y, 0) / 4, bottom = (uint)min(y1 - tile_y, TILE_HEIGHT - 1) / 4;
  const uint columns = (2u << right) - (1u << left);
  const uint rows = (0x1111u << (4 * top)) & (0xffffu >> (12 - 4 * bottom));
  return (columns * rows & wanted[row * size.z + column]) != 0;
}

/* Number of tiles that each of the ellipses reaches, 0 for those not drawn. */
inline void count_tiles(const Ellipse* box, const int* drawn, int4 size, WANTED_ARGUMENTS, uint* count) {
  gI bottom;
  const gI top = row_range(box, size, &bottom);
  const gI row0 = top / TILE_HEIGHT;
  int y0[GW], y1[GW], x0[GW], x1[GW], rows[GW];
  STORE_LANES(top, y0);
  STORE_LANES(bottom, y1);
  STORE_LANES((bottom / TILE_HEIGHT + 1 - row0) & GMASK((top <= bottom) & (bottom >= 0)) & LOAD_LANES(drawn), rows);
  int most = 0;
  for (int i = 0; i < GW; ++i) {
    count[i] = 0;
    most = max(most, rows[i]);
  }
  for (int k = 0; k < most; ++k) {
    gI right;
    const gI left = row_span(box, row0 + k, size, &right);
    STORE_LANES(left, x0);
    STORE_LANES(right, x1);
    for (int i = 0; i < GW; ++i) {
      if (k >= rows[i] || x0[i] > x1[i]) continue;
      const int first = (int)((uint)x0[i] / TILE_WIDTH), last = (int)((uint)x1[i] / TILE_WIDTH);
      if (!sparse) {
        count[i] += (uint)(last - first + 1);
      } else {
        const int row = (int)((uint)y0[i] / TILE_HEIGHT) + k;
        for (int column = first; column <= last; ++column)
          count[i] += (uint)is_wanted(column, row, x0[i], x1[i], y0[i], y1[i], size, WANTED);
      }
    }
  }
}

/* One item for GW Gaussians: writes their tiles to the slots offsets[g] .. offsets[g + 1]. */
kernel void emit_pairs(int n, global const float* restrict boxes, global const uint* restrict offsets, int4 size,
                       WANTED_ARGUMENTS, global uint* restrict slot_tile) {
  const int item = get_global_id(0), g = item * GW;
  if (g >= n) return;
  uint place[GW], end[GW];
  for (int i = 0; i < GW; ++i) {
    place[i] = offsets[min(g + i, n)];
    end[i] = offsets[min(g + i + 1, n)];
  }
  if (place[0] == end[GW - 1]) return;
  const Ellipse box = load_ellipse(boxes, item);
  gI bottom;
  const gI top = row_range(&box, size, &bottom);
  const gI row0 = top / TILE_HEIGHT;
  int y0[GW], y1[GW], x0[GW], x1[GW];
  STORE_LANES(top, y0);
  STORE_LANES(bottom, y1);
  for (int k = 0, more = 1; more && k < size.w; ++k) {
    gI right;
    const gI left = row_span(&box, row0 + k, size, &right);
    STORE_LANES(left, x0);
    STORE_LANES(right, x1);
    more = 0;
    for (int i = 0; i < GW; ++i) {
      if (place[i] == end[i]) continue;
      const int row = (int)((uint)y0[i] / TILE_HEIGHT) + k;
      const int first = (int)((uint)x0[i] / TILE_WIDTH), last = (int)((uint)x1[i] / TILE_WIDTH);
      for (int column = first; x0[i] <= x1[i] && column <= last && place[i] < end[i]; ++column) {
        if (is_wanted(column, row, x0[i], x1[i], y0[i], y1[i], size, WANTED))
          slot_tile[place[i]++] = (uint)(row * size.z + column);
      }
      more |= place[i] < end[i];
    }
  }
}

/* For CPUs, few long chunks: a stable counting sort by tile, one item per chunk of Gaussians consecutive in depth.
   Their pairs are at random places in memory: the places of BIN_BATCH Gaussians are read first, then the first tile of
   each, so that the reads can overlap. */
#define BIN_BATCH 16
typedef struct {
  uint g[BIN_BATCH], begin[BIN_BATCH], end[BIN_BATCH], tile[BIN_BATCH];
} PairBatch;
inline void load_pairs(PairBatch* b, int count, global const uint* restrict order, global const uint* restrict offsets,
                       global const uint* restrict slot_tile) {
  for (int i = 0; i < count; ++i) b->g[i] = order[i];
  for (int i = 0; i < count; ++i) {
    b->begin[i] = offsets[b->g[i]];
    b->end[i] = offsets[b->g[i] + 1];
  }
  for (int i = 0; i < count; ++i) b->tile[i] = b->begin[i] < b->end[i] ? slot_tile[b->begin[i]] : 0u;
}

kernel __attribute__((reqd_work_group_size(1, 1, 1))) void bin_histogram(
    int n, int chunk_size, int tiles, global const uint* restrict order, global const uint* restrict offsets,
    global const uint* restrict slot_tile, global uint* restrict histogram) {
  const int chunk = get_global_id(0);
  global uint* row = histogram + (size_t)chunk * (size_t)tiles;
  for (int t = 0; t < tiles; ++t) row[t] = 0;
  const int end = min(n, (chunk + 1) * chunk_size);
  for (int r = chunk * chunk_size; r < end; r += BIN_BATCH) {
    const int count = min(BIN_BATCH, end - r);
    PairBatch b;
    load_pairs(&b, count, order + r, offsets, slot_tile);
    for (int i = 0; i < count; ++i) {
      if (b.begin[i] == b.end[i]) continue;
      ++row[b.tile[i]];
      for (uint e = b.begin[i] + 1; e < b.end[i]; ++e) ++row[slot_tile[e]];
    }
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
  for (int r = chunk * chunk_size; r < end; r += BIN_BATCH) {
    const int count = min(BIN_BATCH, end - r);
    PairBatch b;
    load_pairs(&b, count, order + r, offsets, slot_tile);
    for (int i = 0; i < count; ++i) {
      for (uint e = b.begin[i]; e < b.end[i]; ++e) {
        const uint p = cursor[e == b.begin[i] ? b.tile[i] : slot_tile[e]]++;
        list[p] = b.g[i];
        slot[p] = e;
      }
    }
  }
}

/* For GPUs, many items: the pairs are put in order of depth, their tiles are sorted by a stable radix sort (`sorted`:
   place by rank), and the lists follow from that. */
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
