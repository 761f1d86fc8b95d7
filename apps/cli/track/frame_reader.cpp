// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/track/frame_reader.hpp"

#include <algorithm>
#include <utility>

namespace odosplat::apps {

FrameReader::FrameReader(const Sequence& sequence, const FrameRange& range, std::size_t ahead)
    : sequence_(sequence), range_{range.begin, std::min(range.end, sequence.size())}, ahead_(ahead), thread_([this] {
        run();
      }) {}

FrameReader::~FrameReader() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

GrayImage FrameReader::take(std::size_t i) {
  std::unique_lock lock(mutex_);
  wanted_ = i;
  while (!entries_.empty() && entries_.front().index < i) entries_.pop_front();
  changed_.notify_all();
  changed_.wait(lock, [&] {
    while (!entries_.empty() && entries_.front().index < i) entries_.pop_front();
    return !entries_.empty();
  });
  Entry entry = std::move(entries_.front());
  entries_.pop_front();
  wanted_ = i + 1;
  changed_.notify_all();
  if (entry.failure) std::rethrow_exception(entry.failure);
  return entry.gray;
}

FrameReader::Entry FrameReader::read(std::size_t i) const {
  Entry entry;
  entry.index = i;
  try {
    entry.gray = sequence_.gray(i);
  } catch (...) {
    entry.failure = std::current_exception();
  }
  return entry;
}

void FrameReader::run() {
  std::unique_lock lock(mutex_);
  for (std::size_t next = range_.begin; next < range_.end; ++next) {
    changed_.wait(lock, [this] { return stop_ || entries_.size() < ahead_; });
    if (stop_) return;
    next = std::max(next, wanted_);
    if (next >= range_.end) return;
    lock.unlock();
    Entry entry = read(next);
    lock.lock();
    entries_.push_back(std::move(entry));
    changed_.notify_all();
  }
}

}  // namespace odosplat::apps
