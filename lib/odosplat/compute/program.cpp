// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/compute/program.hpp"

#include <utility>

#include "kernels/kernels.hpp"
#include "odosplat/compute/build_watch.hpp"
#include "odosplat/compute/opencl.hpp"
#include "odosplat/compute/program_cache.hpp"

namespace odosplat::compute {
namespace {

// No kernel depends on denormals or signed zeros; mad-enable lets a*b+c become one fused instruction. Not
// -cl-fast-relaxed-math: it optimises away the constant that exp2 adds and subtracts to round, which makes alpha wrong
// by up to 40 % without any error.
// -w: PoCL prints the number of warnings to standard error.
constexpr const char* common_options = "-w -cl-mad-enable -cl-denorms-are-zero -cl-no-signed-zeros";

std::string joined_text(const std::vector<std::string>& files) {
  std::string text(kernels::source("constants.h"));
  for (const std::string& file : files) {
    text += "\n#line 1 \"" + file + "\"\n";
    text += kernels::source(file);
  }
  return text;
}

std::string joined_names(const std::vector<std::string>& files) {
  std::string names;
  for (const std::string& file : files) names += (names.empty() ? "" : " + ") + file;
  return names;
}

std::string build_log(cl_program program, cl_device_id device) {
  std::size_t size = 0;
  clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, 0, nullptr, &size);
  std::string log(size, '\0');
  clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, size, log.data(), nullptr);
  return log;
}

std::shared_ptr<void> owned(cl_program program, std::shared_ptr<ContextImpl> keep) {
  return {program, [keep = std::move(keep)](void* p) { clReleaseProgram(static_cast<cl_program>(p)); }};
}

// Null if the driver does not accept the binary: the caller then builds from source.
std::shared_ptr<void> from_binary(const std::shared_ptr<ContextImpl>& c, const std::vector<unsigned char>& binary,
                                  const std::string& options) {
  if (binary.empty()) return nullptr;
  const unsigned char* data = binary.data();
  const std::size_t size = binary.size();
  cl_int status = CL_SUCCESS;
  cl_int binary_status = CL_SUCCESS;
  cl_program program = clCreateProgramWithBinary(c->context, 1, &c->device, &size, &data, &binary_status, &status);
  if (status != CL_SUCCESS || program == nullptr) return nullptr;
  std::shared_ptr<void> handle = owned(program, c);
  if (binary_status != CL_SUCCESS) return nullptr;
  if (clBuildProgram(program, 1, &c->device, options.c_str(), nullptr, nullptr) != CL_SUCCESS) return nullptr;
  return handle;
}

std::vector<unsigned char> binary_of(cl_program program) {
  std::size_t size = 0;
  if (clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof(size), &size, nullptr) != CL_SUCCESS) return {};
  std::vector<unsigned char> binary(size);
  unsigned char* data = binary.data();
  if (clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof(data), &data, nullptr) != CL_SUCCESS) return {};
  return binary;
}

}  // namespace

Program::Program(const Context& context, const std::vector<std::string>& files, const std::string& options)
    : Program(context, joined_names(files), joined_text(files), options) {}

Program Program::from_text(const Context& context, const std::string& text, const std::string& options) {
  return {context, "text", text, options};
}

Program::Program(const Context& context, std::string label, const std::string& text, const std::string& options)
    : context_(context), label_(std::move(label)) {
  const std::shared_ptr<ContextImpl>& c = context.shared_impl();
  const std::string all_options = std::string(common_options) + (options.empty() ? "" : " ") + options;
  const std::string key = c->info.platform + "\n" + c->info.name + "\n" + c->info.driver_version + "\n" +
                          c->info.opencl_version + "\n" + all_options + "\n" + text;
  const ProgramCache cache = ProgramCache::from_environment();
  program_ = from_binary(c, cache.load(key), all_options);
  if (program_) return;

  const BuildWatch watch(*c);
  const char* source = text.c_str();
  const std::size_t length = text.size();
  cl_int status = CL_SUCCESS;
  cl_program program = clCreateProgramWithSource(c->context, 1, &source, &length, &status);
  check(status, "clCreateProgramWithSource", c->info.name);
  program_ = owned(program, c);
  status = clBuildProgram(program, 1, &c->device, all_options.c_str(), nullptr, nullptr);
  if (status != CL_SUCCESS) {
    throw DeviceError("clBuildProgram of " + label_ + ": " + error_name(status) + " (device " + c->info.name +
                      ", options " + all_options + ")\n" + build_log(program, c->device));
  }
  cache.store(key, binary_of(program));
}

std::string program_cache_fault() { return ProgramCache::from_environment().fault(); }

Kernel Program::kernel(const std::string& name, const std::string& stage) const {
  cl_int status = CL_SUCCESS;
  const std::shared_ptr<ContextImpl>& c = context_.shared_impl();
  cl_kernel kernel = clCreateKernel(static_cast<cl_program>(program_.get()), name.c_str(), &status);
  check(status, "clCreateKernel " + name + " of " + label_, c->info.name);
  std::shared_ptr<_cl_kernel> handle(kernel, [keep = program_](cl_kernel k) { clReleaseKernel(k); });
  return {context_, std::move(handle), name, stage.empty() ? name : stage};
}

void Kernel::set_bytes(unsigned index, const void* value, std::size_t size) {
  const cl_int status = clSetKernelArg(handle_.get(), index, size, value);
  if (status != CL_SUCCESS) {
    check(status, "clSetKernelArg " + std::to_string(index) + " of " + name_, context_.device().name);
  }
}

void Kernel::launch(const Range& range, unsigned arguments) {
  ContextImpl& c = context_.impl();
  cl_uint expected = 0;
  check(clGetKernelInfo(handle_.get(), CL_KERNEL_NUM_ARGS, sizeof(expected), &expected, nullptr), "clGetKernelInfo",
        c.info.name);
  if (expected != arguments) {
    throw DeviceError("kernel " + name_ + " takes " + std::to_string(expected) + " arguments, got " +
                      std::to_string(arguments));
  }
  const std::size_t group = range.local[0] * range.local[1];
  if (group == 0 || group > c.max_work_group) {
    throw DeviceError("kernel " + name_ + ": work-groups of " + std::to_string(group) + " items, " + c.info.name +
                      " takes at most " + std::to_string(c.max_work_group));
  }
  if (range.global[0] == 0 || range.global[1] == 0) return;
  std::size_t global[2];
  for (std::size_t i = 0; i < 2; ++i) {
    global[i] = (range.global[i] + range.local[i] - 1) / range.local[i] * range.local[i];
  }
  const cl_uint dimensions = range.global[1] > 1 || range.local[1] > 1 ? 2 : 1;
  cl_event event = nullptr;
  const cl_int status = clEnqueueNDRangeKernel(c.queue, handle_.get(), dimensions, nullptr, global, range.local.data(),
                                               0, nullptr, c.profile ? &event : nullptr);
  if (status != CL_SUCCESS) check(status, "clEnqueueNDRangeKernel " + name_, c.info.name);
  if (!c.profile) return;
  cl_ulong start = 0;
  cl_ulong end = 0;
  clWaitForEvents(1, &event);
  clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof(start), &start, nullptr);
  clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof(end), &end, nullptr);
  clReleaseEvent(event);
  const auto [entry, added] = c.time_index.try_emplace(stage_ + '\n' + name_, c.times.size());
  if (added) c.times.push_back({stage_, name_, 0.0, 0});
  c.times[entry->second].milliseconds += static_cast<double>(end - start) * 1e-6;
  ++c.times[entry->second].launches;
}

}  // namespace odosplat::compute
