// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/track/pose_stream.hpp"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"

namespace odosplat::apps {
namespace {

constexpr std::size_t most_waiting = 1000;  // lines
constexpr int patience_ms = 20;
constexpr auto farewell = std::chrono::milliseconds(300);

/// A socket whose datagrams go to "HOST:PORT".
int udp_socket(const std::string& where, const std::string& address) {
  const InputError wrong("--stream", "must be - or udp://HOST:PORT, is " + where);
  const std::size_t colon = address.rfind(':');
  if (colon == std::string::npos || colon == 0) throw wrong;
  std::string host = address.substr(0, colon);
  const std::string port = address.substr(colon + 1);
  if (host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  const bool digits = !port.empty() && port.size() <= 5 && port.find_first_not_of("0123456789") == std::string::npos;
  if (!digits || std::stoi(port) < 1 || std::stoi(port) > 65535 || host.empty()) throw wrong;
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  if (const int fault = getaddrinfo(host.c_str(), port.c_str(), &wanted, &found); fault != 0) {
    throw InputError("--stream", where + ": " + gai_strerror(fault));
  }
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(found, freeaddrinfo);
  const int file = socket(found->ai_family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (file < 0 || connect(file, found->ai_addr, found->ai_addrlen) != 0) {
    const std::string reason = std::strerror(errno);
    if (file >= 0) close(file);
    throw InputError("--stream", where + ": " + reason);
  }
  return file;
}

}  // namespace

PoseStream::PoseStream(const std::string& where) : where_(where) {
  static const std::string udp = "udp://";
  if (where == "-") {
    file_ = STDOUT_FILENO;
  } else if (where.starts_with(udp)) {
    datagrams_ = true;
    file_ = udp_socket(where, where.substr(udp.size()));
  } else {
    throw InputError("--stream", "must be - or udp://HOST:PORT, is " + where);
  }
  thread_ = std::thread([this] { run(); });
}

PoseStream::~PoseStream() {
  finish();
  if (datagrams_) close(file_);
}

void PoseStream::send(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (closed_ || stop_) {
    ++dropped_;
  } else if (lines_.size() >= most_waiting) {
    drop("its reader is too slow, and lines are dropped");
  } else {
    lines_.push_back(line + "\n");
    changed_.notify_all();
  }
}

/// Counts a line that is not sent. The first one is logged.
void PoseStream::drop(const std::string& reason) {
  if (dropped_++ == 0) log_warning("--stream " + where_ + ": " + reason + "; tracking goes on");
}

void PoseStream::finish() {
  if (!thread_.joinable()) return;
  {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, farewell, [this] { return closed_ || (lines_.empty() && idle_); });
    stop_ = true;
    changed_.notify_all();
  }
  thread_.join();
  const std::lock_guard lock(mutex_);
  for (; !lines_.empty(); lines_.pop_front()) drop("its reader is too slow, and lines are dropped");
}

std::size_t PoseStream::sent() const {
  const std::lock_guard lock(mutex_);
  return sent_;
}

std::size_t PoseStream::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

PoseStream::Sending PoseStream::send_datagram(const std::string& line) const {
  if (::send(file_, line.data(), line.size(), MSG_DONTWAIT | MSG_NOSIGNAL) >= 0) return Sending::done;
  return errno == EINTR ? Sending::not_yet : Sending::refused;
}

/// Writes what the reader takes without waiting and removes it from the line: a pipe that is ready takes a line whole.
PoseStream::Sending PoseStream::write_some(std::string& line) const {
  constexpr std::size_t taken_whole = 4096;  // bytes that a pipe that is ready takes at least
  pollfd wanted{file_, POLLOUT, 0};
  if (poll(&wanted, 1, patience_ms) <= 0) return Sending::not_yet;
  const ssize_t written = ::write(file_, line.data(), std::min(line.size(), taken_whole));
  if (written < 0) return errno == EINTR || errno == EAGAIN ? Sending::not_yet : Sending::closed;
  line.erase(0, static_cast<std::size_t>(written));
  return line.empty() ? Sending::done : Sending::not_yet;
}

void PoseStream::run() {
  // Writing to a closed pipe must return an error instead of ending the program. Other threads are not concerned.
  sigset_t broken_pipe;
  sigemptyset(&broken_pipe);
  sigaddset(&broken_pipe, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &broken_pipe, nullptr);
  std::unique_lock lock(mutex_);
  while (true) {
    idle_ = true;
    changed_.notify_all();
    changed_.wait(lock, [this] { return stop_ || !lines_.empty(); });
    if (stop_) return;
    std::string line = std::move(lines_.front());
    lines_.pop_front();
    idle_ = false;
    Sending sending = Sending::not_yet;
    int fault = 0;
    while (sending == Sending::not_yet && !stop_) {
      lock.unlock();
      sending = datagrams_ ? send_datagram(line) : write_some(line);
      fault = errno;
      lock.lock();
    }
    if (sending == Sending::done) {
      ++sent_;
    } else if (sending == Sending::closed) {
      closed_ = true;
      drop(fault == EPIPE ? "its reader has closed it" : std::string("cannot be written: ") + std::strerror(fault));
      dropped_ += lines_.size();
      lines_.clear();
      changed_.notify_all();
      return;
    } else {
      drop(sending == Sending::refused ? std::string("a line was not sent: ") + std::strerror(fault)
                                       : "its reader is too slow, and lines are dropped");
    }
  }
}

std::string pose_line(const InputFrame& frame, const TrackResult* result, std::optional<double> latency_ms) {
  using Json = nlohmann::ordered_json;
  const bool posed = result != nullptr && result->status != TrackStatus::lost;
  Json line{{"frame", frame.number}, {"time", frame.time}, {"status", to_string(TrackStatus::lost)}};
  line["pose"] = nullptr;
  line["covariance"] = nullptr;
  line["in_map"] = posed && result->in_map;
  line["confirmed"] = nullptr;
  line["latency_ms"] = latency_ms ? Json(*latency_ms) : Json(nullptr);
  if (posed) {
    const Eigen::Vector3d& t = result->T_world_camera.translation();
    const Eigen::Quaterniond& q = result->T_world_camera.rotation();
    line["status"] = to_string(result->status);
    line["pose"] = {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
    Json covariance = Json::array();
    for (int i = 0; i < 6; ++i) {
      for (int j = i; j < 6; ++j) covariance.push_back(result->covariance(i, j));
    }
    line["covariance"] = std::move(covariance);
  }
  if (result != nullptr && result->evidence.verdict != Confirmation::none) {
    line["confirmed"] = result->evidence.probability;
  }
  return line.dump();
}

}  // namespace odosplat::apps
