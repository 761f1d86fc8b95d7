// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "odosplat/compute/context.hpp"

namespace odosplat::compute {

/// Work-items of a launch in one or two dimensions. `global` is rounded up to a multiple of `local`, so kernels have to
/// compare their index with the actual size, which is passed as an argument.
struct Range {
  std::array<std::size_t, 2> global{1, 1};
  std::array<std::size_t, 2> local{1, 1};

  static Range linear(std::size_t items, std::size_t local_size) { return {{items, 1}, {local_size, 1}}; }
  static Range grid(std::size_t w, std::size_t h, std::size_t local_w, std::size_t local_h) {
    return {{w, h}, {local_w, local_h}};
  }
};

/// A kernel with a typed call: kernel(range, buffer, buffer, std::int32_t, float, ...). Arguments are buffers or plain
/// scalars of exactly the kernel's types (32-bit integers, float, or arrays of 2, 4, 8, 16 of them for vector types);
/// bool and double do not compile. The launch is queued, not waited for. A launch of zero items does nothing.
class Kernel {
 public:
  template <typename... Args>
  void operator()(const Range& range, const Args&... args) {
    unsigned index = 0;
    (set(index++, args), ...);
    launch(range, index);
  }

 private:
  friend class Program;
  Kernel(Context context, std::shared_ptr<_cl_kernel> handle, std::string name, std::string stage)
      : context_(std::move(context)), handle_(std::move(handle)), name_(std::move(name)), stage_(std::move(stage)) {}

  template <typename T>
  void set(unsigned index, const Buffer<T>& buffer) {
    _cl_mem* handle = buffer.handle();
    set_bytes(index, &handle, sizeof(handle));  // NOLINT(bugprone-sizeof-expression): the handle itself is the argument
  }
  template <typename T>
  void set(unsigned index, const T& value) {
    static_assert(std::is_same_v<T, std::int32_t> || std::is_same_v<T, std::uint32_t> || std::is_same_v<T, float> ||
                      IsVector<T>::value,
                  "kernel scalars are std::int32_t, std::uint32_t, float or std::array of 2, 4, 8 or 16 of them");
    set_bytes(index, &value, sizeof(value));
  }
  template <typename T>
  struct IsVector : std::false_type {};
  template <typename T, std::size_t N>
  struct IsVector<std::array<T, N>> : std::bool_constant<sizeof(T) == 4 && (N == 2 || N == 4 || N == 8 || N == 16)> {};

  void set_bytes(unsigned index, const void* value, std::size_t size);
  void launch(const Range& range, unsigned arguments);

  Context context_;
  std::shared_ptr<_cl_kernel> handle_;
  std::string name_;
  std::string stage_;
};

/// Kernels built from files of the folder kernels/ for the context's device. `files` are joined in the order given
/// (constants.h always comes first). Options: -D NAME=VALUE and the like; "-cl-mad-enable -cl-denorms-are-zero
/// -cl-no-signed-zeros" are always set (and never -cl-fast-relaxed-math: it breaks the magic-number rounding of exp2).
/// Binaries are kept in a cache on disk (the folder kernels of ODOSPLAT_CACHE_DIR, else of $XDG_CACHE_HOME/odosplat,
/// else of ~/.cache/odosplat; the word "off" disables it), keyed by source, options, device and driver version; a
/// damaged entry or one that other users can write to is rebuilt, and a folder that other users can write to is not
/// used (program_cache_fault()).
/// Throws DeviceError with the build log.
class Program {
 public:
  Program(const Context& context, const std::vector<std::string>& files, const std::string& options = "");
  /// Builds source text that is not in the folder kernels/ (for tests).
  static Program from_text(const Context& context, const std::string& text, const std::string& options = "");

  /// stage: the stage to which this kernel's time is added (KernelTime); empty: a stage of its own.
  Kernel kernel(const std::string& name, const std::string& stage = "") const;

 private:
  Program(const Context& context, std::string label, const std::string& text, const std::string& options);
  Context context_;
  std::string label_;
  std::shared_ptr<void> program_;
};

/// Why the cache folder on disk exists but is not used, in one line that says what to do; empty otherwise.
std::string program_cache_fault();

}  // namespace odosplat::compute
