/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   For images of which only some pixels are wanted: selects the Gaussians that may reach a block of 4 x 4 pixels with a
   wanted pixel, and copies the wanted pixels from the images. Compiled after projection.cl. */

/* Radius of an opaque Gaussian in standard deviations: sqrt(2 ln 255) = 3.3290, enlarged for rounding and for the
   margin of the tile test. */
#define MOST_REACH 3.3302f
#define PIXEL_MARGIN 0.01f

/* One item for `chunk` Gaussians: writes the indices of those kept, in order, from kept[item * chunk] on. The test
   replaces each Gaussian by a ball with its longest axis, which takes a fifth of the time of its projection.
   wanted_sums: two-dimensional prefix sums of the blocks with a wanted pixel, `blocks_wide` + 1 per row, so that four
   of them give the number in a rectangle. */
kernel __attribute__((reqd_work_group_size(1, 1, 1))) void keep_near_wanted(
    int n, int chunk, global const float* restrict positions, global const float* restrict log_scales, float16 pose,
    float8 lens, int4 size, float dilation, int blocks_wide, global const uint* restrict wanted_sums,
    global uint* restrict kept, global uint* restrict kept_counts) {
  const int item = get_global_id(0), end = min(n, (item + 1) * chunk);
  global uint* to = kept + item * chunk;
  uint count = 0;
  for (int first = item * chunk; first < end; first += GW) {
    const gI at = group_of(first, n);
    const gV position = gather_gV(positions, at), log_scale = gather_gV(log_scales, at);
    const gF x = pose.s0 * position.x + pose.s1 * position.y + pose.s2 * position.z + pose.s9;
    const gF y = pose.s3 * position.x + pose.s4 * position.y + pose.s5 * position.z + pose.sa;
    const gF z = pose.s6 * position.x + pose.s7 * position.y + pose.s8 * position.z + pose.sb;
    const gF inverse_z = 1.0f / z, hx = x * inverse_z, hy = y * inverse_z;
    const gF radius = exp(max(log_scale.x, max(log_scale.y, log_scale.z))) * inverse_z;
    const gF tx = min(max(hx, (gF)(lens.s4)), (gF)(lens.s5)), ty = min(max(hy, (gF)(lens.s6)), (gF)(lens.s7));
    /* |row of the projected square root| <= f radius |(1, 0, -tx)| */
    const gF rx = lens.s0 * radius, ry = lens.s1 * radius;
    const gF half_x = MOST_REACH * sqrt(rx * rx * (1.0f + tx * tx) + dilation) + PIXEL_MARGIN;
    const gF half_y = MOST_REACH * sqrt(ry * ry * (1.0f + ty * ty) + dilation) + PIXEL_MARGIN;
    const gF u = lens.s0 * hx + lens.s2, v = lens.s1 * hy + lens.s3;
    const gF right = (gF)((float)(size.x - 1)), bottom = (gF)((float)(size.y - 1)), zero = (gF)(0.0f);
    const gI seen = GMASK((z >= 0.999f * NEAR_DEPTH) & (u + half_x >= zero) & (u - half_x <= right) &
                          (v + half_y >= zero) & (v - half_y <= bottom));
    int is_seen[GW], left_block[GW], right_block[GW], top_block[GW], bottom_block[GW];
    STORE_LANES(seen, is_seen);
    STORE_LANES(to_gI(min(max(u - half_x, zero), right)) / 4, left_block);
    STORE_LANES(to_gI(min(max(u + half_x, zero), right)) / 4, right_block);
    STORE_LANES(to_gI(min(max(v - half_y, zero), bottom)) / 4, top_block);
    STORE_LANES(to_gI(min(max(v + half_y, zero), bottom)) / 4, bottom_block);
    const int lanes = min(GW, end - first);
    for (int i = 0; i < lanes; ++i) {
      if (is_seen[i] == 0) continue;
      global const uint* above = wanted_sums + top_block[i] * (blocks_wide + 1);
      global const uint* below = wanted_sums + (bottom_block[i] + 1) * (blocks_wide + 1);
      const int l = left_block[i], r = right_block[i] + 1;
      if (below[r] - below[l] != above[r] - above[l]) to[count++] = (uint)(first + i);
    }
  }
  kept_counts[item] = count;
}

/* Concatenates the items' lists. */
kernel __attribute__((reqd_work_group_size(1, 1, 1))) void join_kept(int chunk, global const uint* restrict kept,
                                                                     global const uint* restrict kept_counts,
                                                                     global const uint* restrict starts,
                                                                     global uint* restrict selected) {
  const int item = get_global_id(0);
  for (uint i = 0; i < kept_counts[item]; ++i) selected[starts[item] + i] = kept[(uint)(item * chunk) + i];
}

/* One item per wanted pixel: copies its values from an image of `planes` planes. */
kernel void pick_pixels(int count, global const int* restrict places, int planes, int pixels,
                        global const float* restrict image, global float* restrict picked) {
  const int i = get_global_id(0);
  if (i >= count) return;
  for (int plane = 0; plane < planes; ++plane) picked[plane * count + i] = image[plane * pixels + places[i]];
}
