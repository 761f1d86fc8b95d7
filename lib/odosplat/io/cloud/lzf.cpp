// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud/lzf.hpp"

#include <algorithm>
#include <utility>

#include "odosplat/core/error.hpp"

namespace odosplat {

LzfStream::LzfStream(std::string name, std::istream& in, std::uint64_t begin, std::uint64_t end)
    : name_(std::move(name)), in_(&in), at_(begin), end_(end) {}

void LzfStream::fail() const { throw InputError(name_, "the compressed data are broken or cut off"); }

std::uint8_t LzfStream::byte() {
  if (used_ == buffer_.size()) {
    if (at_ >= end_) fail();
    buffer_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(end_ - at_, std::uint64_t{1} << 14)));
    in_->clear();
    in_->seekg(static_cast<std::streamoff>(at_));
    in_->read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    if (static_cast<std::size_t>(in_->gcount()) != buffer_.size()) throw InputError(name_, "cannot be read");
    at_ += buffer_.size();
    used_ = 0;
  }
  return static_cast<std::uint8_t>(buffer_[used_++]);
}

void LzfStream::next_run() {
  const std::size_t control = byte();
  if (control < 32) {
    literal_ = control + 1;
    return;
  }
  std::size_t length = control >> 5;
  if (length == 7) length += byte();
  repeat_ = length + 2;
  distance_ = ((control & 31) << 8 | byte()) + 1;
  if (distance_ > made_) fail();
}

void LzfStream::read(char* to, std::size_t n) {
  for (; n > 0; --n) {
    if (literal_ == 0 && repeat_ == 0) next_run();
    char value = 0;
    if (literal_ > 0) {
      value = static_cast<char>(byte());
      --literal_;
    } else {
      value = window_[(made_ - distance_) % window_size];
      --repeat_;
    }
    window_[made_++ % window_size] = value;
    if (to) *to++ = value;
  }
}

}  // namespace odosplat
