// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "odosplat/io/temporary_file.hpp"

namespace odosplat {

/// synced: the new file is written to the disk before it replaces the old one, so that a power failure leaves either
/// the old or the complete new file. fast: without that; for many files that are quickly made again, such as rendered
/// images.
enum class Durability { synced, fast };

/// plain: nothing depends on the temporary file's name. keep_extension: it ends in the output's extension, in lower
/// case, for encoders that choose the format by it.
enum class TemporaryName { plain, keep_extension };

/// Folders that were created for an output. The destructor removes those that are empty, so that a run that fails
/// before it writes leaves nothing behind.
class MadeFolders {
 public:
  explicit MadeFolders(std::vector<std::string> folders) : folders_(std::move(folders)) {}
  ~MadeFolders();
  MadeFolders(MadeFolders&&) = default;
  MadeFolders& operator=(MadeFolders&&) = delete;
  /// The folders are not removed, for example because another program will write into them.
  void keep() { folders_.clear(); }

 private:
  std::vector<std::string> folders_;  // innermost first
};

/// A file that is written under a temporary name in the same folder and renamed at the end: a reader sees the old file
/// or the whole new one, never a part. Missing parent folders are created. If the path is a symbolic link, the file
/// that it points to is replaced; links that belong neither to this user nor to root are refused, and so are a path at
/// which there is something other than a regular file, "-", and the links of open files (/dev/stdout). A file that
/// replaces another gets its mode and, as far as this user is permitted to set them, its owner and group; a file that
/// replaces none gets mode 0666 reduced by the umask.
/// Every call throws InputError naming the path and the reason ("cannot be written"). Without commit() the destructor
/// removes everything. Not thread safe; different files may be written by different threads.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path, TemporaryName name = TemporaryName::plain);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  /// Path of the temporary file that holds the content until commit(), for encoders that open their output by name.
  const std::string& temporary_name() const;
  /// Renames the file to its final name. To be called once, after the last write.
  void commit(Durability durability = Durability::synced);

 private:
  [[noreturn]] void fail(const std::string& reason);

  std::string path_;
  std::string target_;  // path_ with links at its end resolved
  MadeFolders made_;
  int old_mode_ = -1;  // of the file that is replaced; -1: there is none
  unsigned old_owner_ = 0;
  unsigned old_group_ = 0;
  std::unique_ptr<TemporaryFile> temporary_;
};

/// Writes a whole file at once.
void write_file_atomically(const std::string& path, std::string_view bytes, Durability durability = Durability::synced);

/// Creates the folder (and its parents) if it is missing and verifies that files can be written there; throws
/// InputError otherwise. Removes temporary files that killed runs left in it. Programs call this before they start to
/// compute, and keep the returned object until they have written their output.
[[nodiscard]] MadeFolders ensure_output_folder(const std::string& path);

/// The same for the folder of a file that will be written later; removes only temporary files of that file. Throws
/// InputError also if the file cannot be replaced (see AtomicFile).
[[nodiscard]] MadeFolders ensure_output_file(const std::string& path);

/// Size limits for files that are read into memory as a whole; a larger file could fill the memory before its content
/// is checked. Lists, trajectories and descriptions of millions of lines are below the first, models and maps of
/// millions of points below the second.
inline constexpr std::uint64_t max_text_bytes = std::uint64_t{256} << 20U;
inline constexpr std::uint64_t max_data_bytes = std::uint64_t{4} << 30U;

/// Whole content of a regular file of max_bytes at most. Throws InputError if it is missing, larger, not a regular file
/// (a folder, a FIFO, a device; the call does not wait for their data), or cannot be read.
std::string read_file(const std::string& path, std::uint64_t max_bytes = max_text_bytes);

/// Throws InputError unless path is a regular file or a link to one. For readers that open the file themselves.
void require_regular_file(const std::string& path);

}  // namespace odosplat
