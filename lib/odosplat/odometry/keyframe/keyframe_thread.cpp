// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/keyframe/keyframe_thread.hpp"

#include <utility>

namespace odosplat {

KeyframeThread::KeyframeThread(KeyframeBackend& backend) : backend_(backend), thread_([this] { run(); }) {}

KeyframeThread::~KeyframeThread() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

bool KeyframeThread::request(KeyframeRequest request) {
  {
    const std::lock_guard lock(mutex_);
    if (making_ || finished_ || failure_) return false;
    waiting_ = std::move(request);
  }
  wake_.notify_one();
  return true;
}

std::optional<FinishedKeyframe> KeyframeThread::make(KeyframeRequest wanted, bool to_wait) {
  request(std::move(wanted));
  return to_wait ? wait() : std::nullopt;
}

void KeyframeThread::observe(PosedFrame frame) {
  constexpr std::size_t most = 16;
  {
    const std::lock_guard lock(mutex_);
    observed_.push_back(std::move(frame));
    if (observed_.size() > most) observed_.pop_front();
  }
  wake_.notify_one();
}

void KeyframeThread::prefetch(const SE3& T_world_camera) {
  {
    const std::lock_guard lock(mutex_);
    predicted_ = T_world_camera;
  }
  wake_.notify_one();
}

std::optional<FinishedKeyframe> KeyframeThread::take() {
  const std::lock_guard lock(mutex_);
  return take_locked();
}

std::optional<FinishedKeyframe> KeyframeThread::wait() {
  std::unique_lock lock(mutex_);
  rest_.wait(lock, [this] { return idle(); });
  return take_locked();
}

std::optional<FinishedKeyframe> KeyframeThread::take_locked() {
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  if (finished_) stages_ = finished_->stages;
  return std::exchange(finished_, std::nullopt);
}

void KeyframeThread::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return stop_ || waiting_ || predicted_ || !observed_.empty(); });
    if (stop_) return;
    std::optional<KeyframeRequest> request = std::exchange(waiting_, std::nullopt);
    const std::optional<SE3> predicted = std::exchange(predicted_, std::nullopt);
    const std::deque<PosedFrame> observed = std::exchange(observed_, {});
    making_ = request.has_value();
    busy_ = !making_;
    lock.unlock();
    std::optional<FinishedKeyframe> finished;
    std::exception_ptr failure;
    try {
      for (const PosedFrame& frame : observed) backend_.trace(frame);
      if (request) {
        request->id = made_;
        finished = FinishedKeyframe{*request, backend_.add(*request), backend_.stages()};
        if (finished->outcome.made) ++made_;
      } else if (predicted) {
        backend_.prefetch(*predicted);
      }
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    making_ = busy_ = false;
    if (finished) finished_ = std::move(finished);
    if (failure) failure_ = failure;
    rest_.notify_all();
  }
}

}  // namespace odosplat
