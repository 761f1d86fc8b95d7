// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat {

/// Where the images of a live source come from.
enum class LiveKind {
  none,     // a file or folder, or nothing that exists: recorded
  pipe,     // "-" (standard input), a FIFO, or a link to an open pipe (/dev/stdin)
  device,   // a character device: a camera of Video4Linux (/dev/video0)
  network,  // an address with a scheme: rtsp://, http://, udp://, tcp:// and all else that FFmpeg opens
};

/// Does not open anything. A regular file named "-" is ./-.
LiveKind live_kind(const std::string& source);

/// The address for messages and reports: a password in it (rtsp://user:password@host), and the values of parameters
/// behind the question mark whose names suggest a secret (password, token, key, ...), are replaced by ***. Paths of
/// files are returned as they are.
std::string shown_address(const std::string& source);

}  // namespace odosplat
