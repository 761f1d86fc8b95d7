// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/video/pipe_bytes.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr int patience_ms = 20;

}  // namespace

PipeBytes::PipeBytes(const std::string& source, std::function<bool()> given_up) : given_up_(std::move(given_up)) {
  // A copy, so that standard input stays open. Without O_NONBLOCK opening a FIFO waits for a writer.
  file_ =
      source == "-" ? fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0) : open(source.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file_ < 0) throw InputError(source, std::string("cannot be opened: ") + std::strerror(errno));
  if (isatty(file_) == 1) {
    close(file_);
    throw InputError(source, "standard input is a terminal, where a video stream is expected");
  }
}

PipeBytes::~PipeBytes() { close(file_); }

PipeBytes::Result PipeBytes::read(std::uint8_t* to, std::size_t most, int& count) {
  while (!given_up_()) {
    pollfd wanted{file_, POLLIN, 0};
    const int ready = poll(&wanted, 1, patience_ms);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const ssize_t got = ready < 0 ? -1 : ::read(file_, to, most);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    count = got < 0 ? errno : static_cast<int>(got);
    return got < 0 ? Result::failed : got == 0 ? Result::end : Result::bytes;
  }
  return Result::given_up;
}

}  // namespace odosplat
