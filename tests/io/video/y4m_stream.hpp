// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace odosplat::test {

/// A YUV4MPEG stream of 64x48 at 50 images per second: its beginning, and images of one grey level each, which show the
/// number of the image.
inline std::string y4m_header() { return "YUV4MPEG2 W64 H48 F50:1 Ip A1:1 C420jpeg\n"; }
inline int y4m_level(std::size_t number) { return 20 + 2 * static_cast<int>(number % 100); }
inline std::string y4m_image(std::size_t number) {
  constexpr std::size_t pixels = 64 * 48;
  return "FRAME\n" + std::string(pixels, static_cast<char>(y4m_level(number))) + std::string(pixels / 2, '\x80');
}
inline std::string y4m_images(std::size_t begin, std::size_t end) {
  std::string bytes;
  for (std::size_t k = begin; k < end; ++k) bytes += y4m_image(k);
  return bytes;
}

/// Writes all bytes; false if the reader is gone.
inline bool write_all(int file, const std::string& bytes) {
  std::signal(SIGPIPE, SIG_IGN);
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = ::write(file, bytes.data() + done, bytes.size() - done);
    if (written <= 0) return false;
    done += static_cast<std::size_t>(written);
  }
  return true;
}

/// A TCP server on a port of the loopback interface that is free.
class TcpServer {
 public:
  TcpServer() : file_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(here);
    if (bind(file_, reinterpret_cast<sockaddr*>(&here), size) != 0 || listen(file_, 4) != 0 ||
        getsockname(file_, reinterpret_cast<sockaddr*>(&here), &size) != 0) {
      throw std::runtime_error("no TCP server");
    }
    port_ = ntohs(here.sin_port);
  }
  ~TcpServer() { close(file_); }
  TcpServer(const TcpServer&) = delete;
  TcpServer& operator=(const TcpServer&) = delete;

  int port() const { return port_; }
  std::string address() const { return "tcp://127.0.0.1:" + std::to_string(port_); }
  /// Waits for the next client; the caller closes it.
  int accept_client() const { return accept(file_, nullptr, nullptr); }

 private:
  int file_;
  int port_ = 0;
};

}  // namespace odosplat::test
