// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/bench/yardstick.hpp"

#include <algorithm>
#include <atomic>
#include <barrier>
#include <chrono>
#include <thread>
#include <utility>

#include "tests/bench/yardstick_parts.hpp"

namespace odosplat {
#if !defined(__x86_64__)
// On other processors these are never called, because supported() is false.
void yard::project_part(const Gaussians&, const View&, std::size_t, std::size_t, Splat*, std::uint32_t*, std::uint32_t*,
                        std::uint32_t*, Part&) {}
void yard::composite_tile(const View&, int, const std::uint32_t*, std::size_t, const Splat*, float*) {}
#endif
namespace {

using yard::Splat;

constexpr int radix_bits = 11;
constexpr std::size_t radix_size = std::size_t{1} << radix_bits;

struct Keyed {
  std::uint32_t key, gaussian;
};

std::size_t begin_of(std::size_t n, std::size_t worker) { return n * worker / Yardstick::threads; }

double milliseconds(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

}  // namespace

struct Yardstick::Impl {
  Gaussians gaussians;
  yard::View view;
  std::size_t n = 0, tiles = 0;
  std::vector<Splat> splats;
  std::vector<std::uint32_t> keys, first, count, list, tile_start;
  std::vector<Keyed> order, other;
  std::vector<yard::Part> parts;
  std::array<std::vector<std::uint32_t>, threads> digits, histogram;
  std::vector<float> depth;
  std::barrier<> all{threads};
  std::atomic<std::size_t> next_part{0}, next_tile{0};
  std::array<std::chrono::steady_clock::time_point, 5> at;

  void project() {
    for (std::size_t part = next_part++; part < parts.size(); part = next_part++) {
      const std::size_t begin = part * yard::part_size;
      yard::project_part(gaussians, view, begin, std::min(n, begin + yard::part_size), splats.data(), keys.data(),
                         first.data(), count.data(), parts[part]);
    }
  }
  void sort(std::size_t worker) {
    const std::size_t begin = begin_of(n, worker), end = begin_of(n, worker + 1);
    for (std::size_t i = begin; i < end; ++i) order[i] = {keys[i], static_cast<std::uint32_t>(i)};
    for (int pass = 0; pass < 3; ++pass) {
      const std::vector<Keyed>& in = pass == 1 ? other : order;
      std::vector<Keyed>& out = pass == 1 ? order : other;
      const int shift = pass * radix_bits;
      std::vector<std::uint32_t>& mine = digits[worker];
      mine.assign(radix_size, 0);
      for (std::size_t i = begin; i < end; ++i) ++mine[in[i].key >> shift & (radix_size - 1)];
      all.arrive_and_wait();
      if (worker == 0) {
        std::uint32_t sum = 0;
        for (std::size_t d = 0; d < radix_size; ++d) {
          for (std::vector<std::uint32_t>& one : digits) sum += std::exchange(one[d], sum);
        }
      }
      all.arrive_and_wait();
      for (std::size_t i = begin; i < end; ++i) out[mine[in[i].key >> shift & (radix_size - 1)]++] = in[i];
      all.arrive_and_wait();
    }
  }
  template <typename Visit>
  void each_pair(std::size_t worker, const Visit& visit) const {
    for (std::size_t r = begin_of(n, worker); r < begin_of(n, worker + 1); ++r) {
      const std::uint32_t g = other[r].gaussian;
      const std::uint32_t* tile = parts[g / yard::part_size].tiles.data() + first[g];
      for (std::uint32_t k = 0; k < count[g]; ++k) visit(g, tile[k]);
    }
  }
  void bin(std::size_t worker) {
    std::vector<std::uint32_t>& mine = histogram[worker];
    mine.assign(tiles, 0);
    each_pair(worker, [&](std::uint32_t, std::uint32_t tile) { ++mine[tile]; });
    all.arrive_and_wait();
    if (worker == 0) {
      std::uint32_t sum = 0;
      for (std::size_t t = 0; t < tiles; ++t) {
        tile_start[t] = sum;
        for (std::vector<std::uint32_t>& one : histogram) sum += std::exchange(one[t], sum);
      }
      tile_start[tiles] = sum;
      list.resize(std::max(list.size(), static_cast<std::size_t>(sum)));
    }
    all.arrive_and_wait();
    each_pair(worker, [&](std::uint32_t g, std::uint32_t tile) { list[mine[tile]++] = g; });
    all.arrive_and_wait();
  }
  void composite() {
    for (std::size_t tile = next_tile++; tile < tiles; tile = next_tile++) {
      yard::composite_tile(view, static_cast<int>(tile), list.data() + tile_start[tile],
                           tile_start[tile + 1] - tile_start[tile], splats.data(), depth.data());
    }
  }
  void work(std::size_t worker) {
    const auto mark = [&](std::size_t stage) {
      if (worker == 0) at[stage] = std::chrono::steady_clock::now();
    };
    mark(0);
    project();
    all.arrive_and_wait();
    mark(1);
    sort(worker);
    mark(2);
    bin(worker);
    mark(3);
    composite();
    all.arrive_and_wait();
    mark(4);
  }
};

bool Yardstick::supported() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
#else
  return false;
#endif
}

Yardstick::Yardstick(const Gaussians& gaussians, const Camera& camera, const SE3& T_world_camera)
    : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  m.gaussians = gaussians;
  m.n = gaussians.size();
  const SE3 T_camera_world = T_world_camera.inverse();
  const Eigen::Matrix3d R = T_camera_world.rotation_matrix();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m.view.pose[static_cast<std::size_t>(3 * r + c)] = static_cast<float>(R(r, c));
    m.view.pose[static_cast<std::size_t>(9 + r)] = static_cast<float>(T_camera_world.translation()[r]);
  }
  const double margin_x = static_cast<double>(JACOBIAN_MARGIN) * 0.5 * camera.width / camera.fx;
  const double margin_y = static_cast<double>(JACOBIAN_MARGIN) * 0.5 * camera.height / camera.fy;
  m.view.lens = {static_cast<float>(camera.fx),
                 static_cast<float>(camera.fy),
                 static_cast<float>(camera.cx),
                 static_cast<float>(camera.cy),
                 static_cast<float>((-0.5 - camera.cx) / camera.fx - margin_x),
                 static_cast<float>((camera.width - 0.5 - camera.cx) / camera.fx + margin_x),
                 static_cast<float>((-0.5 - camera.cy) / camera.fy - margin_y),
                 static_cast<float>((camera.height - 0.5 - camera.cy) / camera.fy + margin_y)};
  m.view.width = camera.width;
  m.view.height = camera.height;
  m.view.columns = (camera.width + TILE_WIDTH - 1) / TILE_WIDTH;
  m.view.rows = (camera.height + TILE_HEIGHT - 1) / TILE_HEIGHT;
  m.tiles = static_cast<std::size_t>(m.view.columns) * static_cast<std::size_t>(m.view.rows);
  m.splats.resize(m.n + 8);
  m.keys.resize(m.n + 8);
  m.first.resize(m.n + 8);  // written in groups of eight
  m.count.resize(m.n + 8);
  m.order.resize(m.n);
  m.other.resize(m.n);
  m.tile_start.resize(m.tiles + 1);
  m.parts.resize((m.n + yard::part_size - 1) / yard::part_size);
  m.depth.resize(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
}

Yardstick::~Yardstick() = default;

void Yardstick::render() {
  Impl& m = *impl_;
  m.next_part = 0;
  m.next_tile = 0;
  std::array<std::thread, threads> workers;
  for (std::size_t i = 0; i < workers.size(); ++i) workers[i] = std::thread([&m, i] { m.work(i); });
  for (std::thread& worker : workers) worker.join();
}

const std::vector<float>& Yardstick::depth() const { return impl_->depth; }
std::size_t Yardstick::pairs() const { return impl_->tile_start.back(); }
Yardstick::Stages Yardstick::stages() const {
  const auto& at = impl_->at;
  return {milliseconds(at[0], at[1]), milliseconds(at[1], at[2]), milliseconds(at[2], at[3]),
          milliseconds(at[3], at[4])};
}

}  // namespace odosplat
