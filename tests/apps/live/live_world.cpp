// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/apps/live/live_world.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <sstream>
#include <stdexcept>

#include "odosplat/io/sequence/sequence.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps_test {
namespace {

/// Grey as luma of limited range: 0..1 is 16..235.
std::string stream_image(const GrayImage& gray) {
  std::string bytes = "FRAME\n";
  for (const float value : gray)
    bytes += static_cast<char>(static_cast<unsigned char>(std::lround(16.0F + 219.0F * value)));
  return bytes + std::string(gray.total() / 2, '\x80');
}

bool write_all(int file, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = write(file, bytes.data() + done, bytes.size() - done);
    if (written <= 0) return false;
    done += static_cast<std::size_t>(written);
  }
  return true;
}

}  // namespace

LiveWorld::LiveWorld(int frames) {
  std::signal(SIGPIPE, SIG_IGN);
  write_tiny_sequence(sequence(), frames);
  truth_ = read_trajectory(sequence() + "/groundtruth.txt");
  const Sequence images = Sequence::open(sequence());
  for (std::size_t i = 0; i < images.size(); ++i) images_.push_back(stream_image(images.gray(i)));
  header_ = "YUV4MPEG2 W160 H120 F30:1 Ip A1:1 C420jpeg\n";
  const RunResult cloud =
      run_odosplat({"cloud", sequence(), "--every", "5", "--voxel", "0.03", "--out", file("cloud.ply")});
  if (cloud.status != 0) throw std::runtime_error(cloud.err);
  if (mkfifo(fifo().c_str(), 0600) != 0) throw std::runtime_error("no FIFO");
}

LiveWorld::~LiveWorld() {
  stop_ = true;
  if (writer_.joinable()) writer_.join();
}

void LiveWorld::play(std::size_t images, int pause_ms, bool silent) {
  if (writer_.joinable()) writer_.join();
  writer_ = std::thread([this, images, pause_ms, silent] {
    int to = -1;
    while (to < 0 && !stop_) {
      to = open(fifo().c_str(), O_WRONLY | O_NONBLOCK);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    if (to < 0) return;
    fcntl(to, F_SETFL, 0);
    bool there = write_all(to, header_);
    for (std::size_t k = 0; k < images && there && !stop_; ++k) {
      // There and back again, so that the stream may be longer than the sequence.
      const std::size_t period = 2 * images_.size() - 2;
      const std::size_t at = k % period;
      there = write_all(to, images_[at < images_.size() ? at : period - at]);
      std::this_thread::sleep_for(std::chrono::milliseconds(pause_ms));
    }
    while (silent && there && !stop_) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    close(to);
  });
}

std::vector<std::string> LiveWorld::track(const std::string& source, const std::vector<std::string>& more) const {
  std::ostringstream start;
  start.precision(17);
  const Eigen::Vector3d& t = truth_[0].T_world_camera.translation();
  const Eigen::Quaterniond& q = truth_[0].T_world_camera.rotation();
  start << t.x() << " " << t.y() << " " << t.z() << " " << q.x() << " " << q.y() << " " << q.z() << " " << q.w();
  std::vector<std::string> words{"track",     source,     "--method", "surfel", "--cloud", file("cloud.ply"), "--start",
                                 start.str(), "--camera", camera(),   "--out",  out(),     "--relocalise",    "off"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

UdpReader::UdpReader() : file_(socket(AF_INET, SOCK_DGRAM, 0)) {
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(here);
  if (bind(file_, reinterpret_cast<sockaddr*>(&here), size) != 0 ||
      getsockname(file_, reinterpret_cast<sockaddr*>(&here), &size) != 0) {
    throw std::runtime_error("no UDP socket");
  }
  port_ = ntohs(here.sin_port);
  thread_ = std::thread([this] {
    std::string bytes(65536, '\0');
    while (true) {
      pollfd wanted{file_, POLLIN, 0};
      if (poll(&wanted, 1, 20) <= 0) {
        if (stop_) return;
        continue;
      }
      const ssize_t got = recv(file_, bytes.data(), bytes.size(), 0);
      if (got < 0) continue;
      lines_.push_back(bytes.substr(0, static_cast<std::size_t>(got)));
      ++count_;
    }
  });
}

UdpReader::~UdpReader() {
  finish();
  close(file_);
}

std::vector<std::string> UdpReader::finish() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
  return lines_;
}

}  // namespace odosplat::apps_test
