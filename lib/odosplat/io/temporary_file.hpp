// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <sys/types.h>

#include <string>

namespace odosplat {

/// Temporary files beside an output, called NAME.odosplat-<16 hexadecimal digits>.part (the output's extension follows
/// where an encoder tells the format by it). Names are random and made exclusively, so that nothing planted there is
/// opened or followed. Each is locked (flock) while its process works on it: one that nobody holds is the leftover of a
/// process that was killed. Private to this folder.
class TemporaryFile {
 public:
  /// Makes an empty file beside `path`, which must not end in a link. mode: as open() takes it, before the umask.
  /// extension: ".mp4", ".avi" or none. Throws std::system_error.
  TemporaryFile(const std::string& path, mode_t mode, const std::string& extension = "");
  /// Removes it unless it was renamed.
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int descriptor() const { return file_; }
  const std::string& name() const { return name_; }

  /// Puts it in place of `path`. synced: file and folder entry are on the disk when this returns. Throws
  /// std::system_error.
  void rename_to(const std::string& path, bool synced);

 private:
  std::string name_;
  int file_ = -1;
};

/// Removes temporary files of outputs called `name` or `name.ANYTHING`, such as a checkpoint's, in a folder (empty: of
/// all outputs) that belong to this user and are held by no process. Locks do not reach other machines, so nothing is
/// removed on network file systems. Never throws.
void remove_leftovers(const std::string& folder, const std::string& name);

}  // namespace odosplat
