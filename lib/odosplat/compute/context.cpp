// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/compute/context.hpp"

#include <algorithm>
#include <utility>

#include "odosplat/compute/opencl.hpp"
#include "odosplat/compute/program_cache.hpp"

namespace odosplat::compute {

std::string error_name(cl_int status) {
  switch (status) {
    case CL_DEVICE_NOT_FOUND:
      return "CL_DEVICE_NOT_FOUND";
    case CL_DEVICE_NOT_AVAILABLE:
      return "CL_DEVICE_NOT_AVAILABLE";
    case CL_COMPILER_NOT_AVAILABLE:
      return "CL_COMPILER_NOT_AVAILABLE";
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
      return "CL_MEM_OBJECT_ALLOCATION_FAILURE";
    case CL_OUT_OF_RESOURCES:
      return "CL_OUT_OF_RESOURCES";
    case CL_OUT_OF_HOST_MEMORY:
      return "CL_OUT_OF_HOST_MEMORY";
    case CL_BUILD_PROGRAM_FAILURE:
      return "CL_BUILD_PROGRAM_FAILURE";
    case CL_INVALID_VALUE:
      return "CL_INVALID_VALUE";
    case CL_INVALID_DEVICE:
      return "CL_INVALID_DEVICE";
    case CL_INVALID_CONTEXT:
      return "CL_INVALID_CONTEXT";
    case CL_INVALID_COMMAND_QUEUE:
      return "CL_INVALID_COMMAND_QUEUE";
    case CL_INVALID_MEM_OBJECT:
      return "CL_INVALID_MEM_OBJECT";
    case CL_INVALID_BINARY:
      return "CL_INVALID_BINARY";
    case CL_INVALID_BUILD_OPTIONS:
      return "CL_INVALID_BUILD_OPTIONS";
    case CL_INVALID_PROGRAM:
      return "CL_INVALID_PROGRAM";
    case CL_INVALID_PROGRAM_EXECUTABLE:
      return "CL_INVALID_PROGRAM_EXECUTABLE";
    case CL_INVALID_KERNEL_NAME:
      return "CL_INVALID_KERNEL_NAME";
    case CL_INVALID_KERNEL:
      return "CL_INVALID_KERNEL";
    case CL_INVALID_ARG_INDEX:
      return "CL_INVALID_ARG_INDEX";
    case CL_INVALID_ARG_VALUE:
      return "CL_INVALID_ARG_VALUE";
    case CL_INVALID_ARG_SIZE:
      return "CL_INVALID_ARG_SIZE";
    case CL_INVALID_KERNEL_ARGS:
      return "CL_INVALID_KERNEL_ARGS";
    case CL_INVALID_WORK_GROUP_SIZE:
      return "CL_INVALID_WORK_GROUP_SIZE";
    case CL_INVALID_WORK_ITEM_SIZE:
      return "CL_INVALID_WORK_ITEM_SIZE";
    case CL_INVALID_BUFFER_SIZE:
      return "CL_INVALID_BUFFER_SIZE";
    default:
      return "OpenCL error " + std::to_string(status);
  }
}

void check(cl_int status, const std::string& call, const std::string& device) {
  if (status == CL_SUCCESS) return;
  const bool memory =
      status == CL_MEM_OBJECT_ALLOCATION_FAILURE || status == CL_OUT_OF_HOST_MEMORY || status == CL_INVALID_BUFFER_SIZE;
  throw DeviceError(call + ": " + error_name(status) + " (device " + device + ")" +
                    (memory ? "; too little memory: fewer Gaussians or smaller images need less" : ""));
}

ContextImpl::~ContextImpl() {
  if (queue != nullptr) clReleaseCommandQueue(queue);
  if (context != nullptr) clReleaseContext(context);
}

Context Context::open(const std::string& selector) {
  const std::vector<FoundDevice> found = find_devices();
  std::vector<DeviceInfo> infos;
  infos.reserve(found.size());
  for (const FoundDevice& d : found) infos.push_back(d.info);
  const DeviceInfo& chosen = choose_device(infos, selector);
  if (chosen.platform == "Portable Computing Language") {
    if (const std::string fault = pocl_cache_fault(); !fault.empty()) throw NoSuchDevice(fault);
  }
  auto impl = std::make_shared<ContextImpl>();
  impl->info = chosen;
  impl->device = found[static_cast<std::size_t>(chosen.index)].id;
  cl_int status = CL_SUCCESS;
  impl->context = clCreateContext(nullptr, 1, &impl->device, nullptr, nullptr, &status);
  check(status, "clCreateContext", chosen.name);
  impl->queue = clCreateCommandQueue(impl->context, impl->device, CL_QUEUE_PROFILING_ENABLE, &status);
  check(status, "clCreateCommandQueue", chosen.name);
  check(clGetDeviceInfo(impl->device, CL_DEVICE_MAX_WORK_GROUP_SIZE, sizeof(impl->max_work_group),
                        &impl->max_work_group, nullptr),
        "clGetDeviceInfo", chosen.name);
  return Context(std::move(impl));
}

const DeviceInfo& Context::device() const { return impl_->info; }
void Context::finish() const { check(clFinish(impl_->queue), "clFinish", impl_->info.name); }
void Context::set_profiling(bool on) { impl_->profile = on; }
bool Context::profiling() const { return impl_->profile; }
std::vector<KernelTime> Context::kernel_times() const { return impl_->times; }
std::vector<StageTime> Context::stage_times() const {
  std::vector<StageTime> stages;
  for (const KernelTime& time : impl_->times) {
    auto found = std::find_if(stages.begin(), stages.end(), [&](const StageTime& s) { return s.stage == time.stage; });
    if (found == stages.end()) found = stages.insert(stages.end(), StageTime{time.stage, 0.0, 0, {}});
    found->milliseconds += time.milliseconds;
    found->launches += time.launches;
    found->kernels.push_back(time);
  }
  return stages;
}
void Context::reset_kernel_times() {
  impl_->times.clear();
  impl_->time_index.clear();
}

Memory::Memory(const Context& context, std::size_t bytes)
    : context_(std::shared_ptr<ContextImpl>(context.shared_impl())) {
  cl_int status = CL_SUCCESS;
  // On a CPU the memory is allocated at once, so that a failure is reported here: otherwise PoCL allocates it at the
  // first use and aborts the process if that fails.
  const cl_mem_flags flags = CL_MEM_READ_WRITE | (context.is_cpu() ? CL_MEM_ALLOC_HOST_PTR : 0);
  cl_mem memory = clCreateBuffer(context_->context, flags, bytes, nullptr, &status);
  check(status, "clCreateBuffer of " + std::to_string(bytes) + " bytes", context_->info.name);
  // The deleter holds the context, so that the memory is released before it. A failing release cannot be reported.
  handle_ = std::shared_ptr<_cl_mem>(memory, [keep = context_](cl_mem m) { clReleaseMemObject(m); });
}

void Memory::upload(const void* data, std::size_t bytes, std::size_t offset) {
  check(clEnqueueWriteBuffer(context_->queue, handle_.get(), CL_TRUE, offset, bytes, data, 0, nullptr, nullptr),
        "clEnqueueWriteBuffer", context_->info.name);
}

void Memory::download(void* data, std::size_t bytes, std::size_t offset) const {
  check(clEnqueueReadBuffer(context_->queue, handle_.get(), CL_TRUE, offset, bytes, data, 0, nullptr, nullptr),
        "clEnqueueReadBuffer", context_->info.name);
}

void Memory::fill_zero(std::size_t bytes, std::size_t offset) {
  const cl_uchar zero = 0;
  check(clEnqueueFillBuffer(context_->queue, handle_.get(), &zero, 1, offset, bytes, 0, nullptr, nullptr),
        "clEnqueueFillBuffer", context_->info.name);
}

void Memory::copy_from(const Memory& source, std::size_t bytes) {
  check(clEnqueueCopyBuffer(context_->queue, source.handle_.get(), handle_.get(), 0, 0, bytes, 0, nullptr, nullptr),
        "clEnqueueCopyBuffer", context_->info.name);
}

}  // namespace odosplat::compute
