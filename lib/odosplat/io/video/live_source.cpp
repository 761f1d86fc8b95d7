// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/video/live_source.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/video/ffmpeg_parts.hpp"
#include "odosplat/io/video/live_address.hpp"
#include "odosplat/io/video/live_input.hpp"
#include "odosplat/io/video/stream_clock.hpp"

namespace odosplat {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double first_pause = 0.5;  // [s] before a lost source is opened again
constexpr double longest_pause = 4.0;
constexpr double most_ahead = 5.0;  // [s] by which images may come before their time without a warning
constexpr auto nap = std::chrono::milliseconds(20);
constexpr auto farewell = std::chrono::milliseconds(300);

Clock::duration seconds(double value) {
  constexpr double longest = 1e9;
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::min(value, longest)));
}

double on_steady_clock(Clock::time_point when) {
  return std::chrono::duration<double>(when.time_since_epoch()).count();
}

}  // namespace

/// Shared with the thread, which may outlive the source for as long as a name server or a driver blocks it.
struct LiveSource::State {
  State(const std::string& address, const LiveOptions& wishes)
      : source(address), name(shown_address(address)), kind(live_kind(address)), options(wishes) {}

  struct Slot {
    ffmpeg::Frame frame;
    int quarters = 0;
    double time = 0.0;
    Clock::time_point arrival;
    std::size_t number = 0;
  };

  const std::string source;
  const std::string name;
  const LiveKind kind;
  const LiveOptions options;
  std::atomic<bool> stop{false};

  mutable std::mutex mutex;
  std::condition_variable changed;
  std::optional<Slot> slot;
  bool opened = false;
  bool started = false;
  bool finished = false;   // the thread
  bool delivered = false;  // an image of this connection has been taken
  std::exception_ptr failure;
  std::size_t arrived = 0;
  std::size_t dropped = 0;
  std::size_t dropped_since_take = 0;
  std::size_t damaged = 0;
  std::size_t reconnections = 0;
  std::size_t first_number = 0;  // that of the first image since start()
  cv::Size size;
  int quarters = 0;

  // The thread's own.
  StreamClock clock;
  Clock::time_point deadline;
  Clock::time_point last_arrival;
  bool waits_for_pipe = false;  // between two images
  bool said_silent = false;
  bool said_ahead = false;
  long damaged_before = 0;

  // The caller's own.
  ffmpeg::RgbConverter converter;

  bool given_up();
  void accept(const LiveInput& input);
  std::unique_ptr<LiveInput> connect();
  void read(LiveInput& input);
  std::unique_ptr<LiveInput> connect_again(std::string reason);
  void capture();
};

bool LiveSource::State::given_up() {
  if (stop) return true;
  const Clock::time_point now = Clock::now();
  if (waits_for_pipe && !said_silent && now - last_arrival > seconds(options.stall_timeout)) {
    said_silent = true;
    log_warning(name + formatted(": no image for %.3g s; it is waited for %.3g s more", options.stall_timeout,
                                 options.reconnect));
  }
  return now > deadline;
}

void LiveSource::State::accept(const LiveInput& input) {
  Slot next;
  next.frame = input.frame();
  next.arrival = Clock::now();
  next.quarters = input.quarters();
  if (next.frame == nullptr) return;
  std::unique_lock lock(mutex);
  if (delivered) clock.settle();
  next.time = clock.time_of(input.stamp(), on_steady_clock(next.arrival));
  next.number = arrived++;
  damaged += static_cast<std::size_t>(input.damaged() - std::exchange(damaged_before, input.damaged()));
  if (slot) {
    ++dropped;
    ++dropped_since_take;
  }
  if (!opened) {
    const cv::Size stored(next.frame->width, next.frame->height);
    size = next.quarters % 2 == 0 ? stored : cv::Size(stored.height, stored.width);
    quarters = next.quarters;
  }
  last_arrival = next.arrival;
  said_silent = false;
  slot = std::move(next);
  opened = true;
  changed.notify_all();
  // What a pipe holds is not thrown away while the caller prepares.
  if (kind == LiveKind::pipe) changed.wait(lock, [this] { return started || stop; });
  lock.unlock();
  if (!said_ahead && clock.ahead() > most_ahead) {
    said_ahead = true;
    log_warning(
        name +
        ": its images come faster than their stamps say, and most are dropped; name a recording by its file, or "
        "play it at its own rate (ffmpeg -re)");
  }
}

/// Opens the source and accepts its first image. InputError if it cannot be.
std::unique_ptr<LiveInput> LiveSource::State::connect() {
  waits_for_pipe = false;
  deadline = Clock::now() + seconds(options.open_timeout);
  damaged_before = 0;
  const InputError late(name, formatted("no image came within %.3g s", options.open_timeout));
  try {
    auto input = std::make_unique<LiveInput>(source, options, [this] { return given_up(); });
    const bool first = input->next();
    if (!first && Clock::now() > deadline) throw late;
    if (!first) throw InputError(name, input->fault().empty() ? "holds no image" : input->fault());
    accept(*input);
    return input;
  } catch (const InputError&) {
    if (!stop && Clock::now() > deadline) throw late;
    throw;
  }
}

void LiveSource::State::read(LiveInput& input) {
  last_arrival = Clock::now();
  while (true) {
    const double patience = options.stall_timeout + (kind == LiveKind::pipe ? options.reconnect : 0.0);
    deadline = last_arrival + seconds(patience);
    waits_for_pipe = kind == LiveKind::pipe;
    if (!input.next()) return;
    accept(input);
    last_arrival = Clock::now();
  }
}

/// Opens a lost source again. Null: not within options.reconnect.
std::unique_ptr<LiveInput> LiveSource::State::connect_again(std::string reason) {
  const Clock::time_point lost = Clock::now();
  const Clock::time_point last = lost + seconds(options.reconnect);
  if (options.reconnect > 0.0) {
    log_warning(name +
                formatted(": lost (%s); it is opened again for up to %.6g s", reason.c_str(), options.reconnect));
  }
  for (double pause = first_pause; Clock::now() < last; pause = std::min(2.0 * pause, longest_pause)) {
    {
      std::unique_lock lock(mutex);
      if (changed.wait_until(lock, std::min(last, Clock::now() + seconds(pause)), [this] { return stop.load(); })) {
        return nullptr;
      }
      clock.restart();
      delivered = false;
    }
    try {
      auto input = connect();
      log_warning(name +
                  formatted(": is back after %.1f s", std::chrono::duration<double>(Clock::now() - lost).count()));
      const std::lock_guard lock(mutex);
      ++reconnections;
      return input;
    } catch (const InputError& e) {
      reason = e.what();
      if (reason.starts_with(name + ": ")) reason.erase(0, name.size() + 2);
      if (stop) return nullptr;
    }
  }
  log_warning(name + ": has ended (" + reason + ")");
  return nullptr;
}

void LiveSource::State::capture() {
  std::unique_ptr<LiveInput> input = connect();
  while (input != nullptr) {
    read(*input);
    if (stop) return;
    std::string reason = input->fault();
    const bool in_order = reason.empty() && Clock::now() <= deadline;
    if (reason.empty()) {
      reason = in_order ? "its other end has closed it" : formatted("no image for %.3g s", options.stall_timeout);
    }
    input.reset();
    if (kind == LiveKind::pipe) {
      if (!in_order) log_warning(name + ": has ended (" + reason + ")");
      return;
    }
    input = connect_again(reason);
  }
}

LiveSource::LiveSource(const std::string& source, const LiveOptions& options, const std::function<bool()>& stopped) {
  options.check();
  state_ = std::make_shared<State>(source, options);
  if (state_->kind == LiveKind::none) throw InputError(source, "is no live source");
  std::thread([state = state_] {
    try {
      state->capture();
    } catch (...) {
      const std::lock_guard lock(state->mutex);
      state->failure = std::current_exception();
    }
    const std::lock_guard lock(state->mutex);
    state->finished = true;
    state->changed.notify_all();
  }).detach();
  std::unique_lock lock(state_->mutex);
  // A device, or a name server, may block the thread beyond the time it has.
  const Clock::time_point last = Clock::now() + seconds(options.open_timeout + 1.0);
  while (!state_->opened && !state_->finished) {
    state_->changed.wait_for(lock, nap);
    const bool stop = stopped && stopped();
    if (stop || Clock::now() > last) state_->stop = true;
    if (stop) throw Interrupted();
    if (state_->stop) {
      throw InputError(state_->name, formatted("no image came within %.3g s", options.open_timeout));
    }
  }
  if (state_->failure && !state_->opened) std::rethrow_exception(state_->failure);
}

LiveSource::~LiveSource() {
  std::unique_lock lock(state_->mutex);
  state_->stop = true;
  state_->changed.notify_all();
  state_->changed.wait_for(lock, farewell, [this] { return state_->finished; });
}

const std::string& LiveSource::name() const { return state_->name; }
cv::Size LiveSource::size() const { return state_->size; }
int LiveSource::quarters() const { return state_->quarters; }

void LiveSource::start() {
  State& s = *state_;
  const std::lock_guard lock(s.mutex);
  s.started = true;
  s.first_number = s.slot ? s.slot->number : s.arrived;
  s.dropped = 0;
  s.dropped_since_take = 0;
  s.damaged = 0;
  s.reconnections = 0;
  s.changed.notify_all();
}

std::optional<LiveFrame> LiveSource::take(double wait) {
  State& s = *state_;
  LiveFrame taken;
  State::Slot slot;
  {
    std::unique_lock lock(s.mutex);
    s.changed.wait_for(lock, seconds(wait), [&s] { return s.slot || s.finished; });
    if (!s.slot) {
      if (s.failure) std::rethrow_exception(s.failure);
      return std::nullopt;
    }
    slot = std::move(*s.slot);
    s.slot.reset();
    s.delivered = true;
    taken.dropped = std::exchange(s.dropped_since_take, 0);
    taken.number = slot.number - s.first_number;
  }
  taken.rgb = s.converter.image(s.name, *slot.frame, slot.quarters);
  taken.time = slot.time;
  taken.arrival = slot.arrival;
  return taken;
}

bool LiveSource::ended() const {
  const std::lock_guard lock(state_->mutex);
  return state_->finished && !state_->slot;
}

LiveCounts LiveSource::counts() const {
  const State& s = *state_;
  const std::lock_guard lock(s.mutex);
  return {s.arrived - s.first_number, s.dropped, s.damaged, s.reconnections};
}

}  // namespace odosplat
