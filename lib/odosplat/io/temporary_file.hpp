// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <sys/types.h>

#include <string>

namespace odosplat {

/// A temporary file in the folder of an output, called NAME.odosplat-<16 hexadecimal digits>.part (followed by the
/// output's extension if an encoder chooses the format by it). Names are random and files are created exclusively
/// (O_EXCL), so that no file or link that somebody else placed there is opened. Each is locked (flock) while its
/// process works on it: a file without a lock was left by a process that was killed. Private to this folder.
class TemporaryFile {
 public:
  /// Creates an empty file in the folder of `path`, which must not end in a link. mode: as for open(), before the
  /// umask. extension: ".mp4", ".avi" or none. Throws std::system_error.
  TemporaryFile(const std::string& path, mode_t mode, const std::string& extension = "");
  /// Removes the file unless it was renamed.
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int descriptor() const { return file_; }
  const std::string& name() const { return name_; }

  /// Renames the file to `path`. synced: file and folder entry are written to the disk when this returns. Throws
  /// std::system_error.
  void rename_to(const std::string& path, bool synced);

 private:
  std::string name_;
  int file_ = -1;
};

/// Removes temporary files in `folder` that belong to this user and are locked by no process: those of outputs called
/// `name` or `name.ANYTHING` (such as a checkpoint's), or of all outputs if `name` is empty. Removes nothing on network
/// file systems, because locks of other machines are not visible there. Never throws.
void remove_leftovers(const std::string& folder, const std::string& name);

}  // namespace odosplat
