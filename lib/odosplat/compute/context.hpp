// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "odosplat/compute/device.hpp"

// OpenCL types, declared here so that this header needs no OpenCL header.
struct _cl_mem;     // NOLINT(bugprone-reserved-identifier)
struct _cl_kernel;  // NOLINT(bugprone-reserved-identifier)

namespace odosplat::compute {

/// An OpenCL call failed: the message has the call, the error's name, the device and, for builds, options and log.
class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ContextImpl;

/// Time of one kernel, summed over its launches. A stage is one step of the work, made up of one or more kernels.
struct KernelTime {
  std::string stage;
  std::string name;
  double milliseconds = 0.0;
  long launches = 0;
};

struct StageTime {
  std::string stage;
  double milliseconds = 0.0;
  long launches = 0;
  std::vector<KernelTime> kernels;
};

/// One device with one in-order queue: commands run in the order given, so a caller has to wait only to read results.
/// Copies share the same device and queue. Not thread safe: one thread at a time.
class Context {
 public:
  /// selector as in choose_device. Throws NoSuchDevice also if PoCL would run kernels from a cache folder that other
  /// users can write to (pocl_cache_fault).
  static Context open(const std::string& selector = "");

  const DeviceInfo& device() const;
  bool is_cpu() const { return device().type == DeviceType::cpu; }
  /// Waits until all queued commands have finished.
  void finish() const;

  /// With profiling on, every launch is timed, which waits for each to finish. kernel_times() are in order of first
  /// launch.
  void set_profiling(bool on);
  bool profiling() const;
  std::vector<KernelTime> kernel_times() const;
  /// The same times summed by stage, stages in order of first launch.
  std::vector<StageTime> stage_times() const;
  void reset_kernel_times();

  ContextImpl& impl() const { return *impl_; }
  const std::shared_ptr<ContextImpl>& shared_impl() const { return impl_; }

 private:
  explicit Context(std::shared_ptr<ContextImpl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<ContextImpl> impl_;
};

/// Untyped device memory; use Buffer<T>.
class Memory {
 public:
  Memory() = default;
  Memory(const Context& context, std::size_t bytes);
  void upload(const void* data, std::size_t bytes, std::size_t offset);
  void download(void* data, std::size_t bytes, std::size_t offset) const;
  void fill_zero(std::size_t bytes, std::size_t offset);
  void copy_from(const Memory& source, std::size_t bytes);
  _cl_mem* handle() const { return handle_.get(); }

 private:
  std::shared_ptr<ContextImpl> context_;
  std::shared_ptr<_cl_mem> handle_;
};

/// Device memory of size() elements of a plain type T. Copies share the memory. Contents of a new buffer are undefined.
/// A buffer of size 0 is allowed and may be handed to kernels (it has room for one element).
template <typename T>
class Buffer {
 public:
  Buffer() = default;
  Buffer(const Context& context, std::size_t size)
      : memory_(context, (size > 0 ? size : 1) * sizeof(T)), size_(size), capacity_(size > 0 ? size : 1) {}
  Buffer(const Context& context, const std::vector<T>& data) : Buffer(context, data.size()) { upload(data); }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// Makes size() == size. Keeps the memory and its contents if it is large enough; otherwise allocates new memory with
  /// some room to grow, and the contents are lost.
  void resize(const Context& context, std::size_t size) {
    if (memory_.handle() == nullptr || size > capacity_) {
      capacity_ = size + size / 4 + 1;
      memory_ = Memory(context, capacity_ * sizeof(T));
    }
    size_ = size;
  }
  /// Blocking copies. data.size() must be at most size().
  void upload(const std::vector<T>& data) { upload(data.data(), data.size()); }
  void upload(const T* data, std::size_t count, std::size_t offset = 0) {
    if (count > 0) memory_.upload(data, count * sizeof(T), offset * sizeof(T));
  }
  std::vector<T> download() const {
    std::vector<T> data(size_);
    download(data.data(), size_);
    return data;
  }
  void download(T* data, std::size_t count, std::size_t offset = 0) const {
    if (count > 0) memory_.download(data, count * sizeof(T), offset * sizeof(T));
  }
  /// Queued, not waited for: sets all bytes of all elements to zero.
  void fill_zero() {
    if (size_ > 0) memory_.fill_zero(size_ * sizeof(T), 0);
  }
  /// Queued, not waited for: resizes to source.size() and copies all elements of source.
  void copy_from(const Context& context, const Buffer& source) {
    resize(context, source.size());
    if (size_ > 0) memory_.copy_from(source.memory_, size_ * sizeof(T));
  }
  _cl_mem* handle() const { return memory_.handle(); }

 private:
  Memory memory_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace odosplat::compute
