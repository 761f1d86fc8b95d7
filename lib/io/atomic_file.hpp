// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace odosplat {

/// A file that is written beside its place and renamed at the end: a reader sees the old file or the whole new one,
/// never a part. Missing parent folders are made. Every call throws InputError naming the path and the reason ("cannot
/// be written"). Without commit() the destructor leaves nothing behind. Not thread safe; different files may be written
/// by different threads.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  /// Closes and renames. To be called once, after the last write.
  void commit();

 private:
  [[noreturn]] void fail(int error);
  void discard();

  std::string path_;
  std::string beside_;
  int file_ = -1;
};

/// All of a file at once.
void write_file_atomically(const std::string& path, std::string_view bytes);

/// Makes the folder (and its parents) if need be and proves that files can be written there. InputError otherwise.
/// Programs call this before they compute anything.
void ensure_output_folder(const std::string& path);

/// The same for the folder of a file that will be written later.
void ensure_output_file(const std::string& path);

/// The most that a file read at once may hold: what is beyond fills the memory before its content can be judged. Lists,
/// trajectories and descriptions of millions of lines lie below the first, models and maps of millions of points below
/// the second.
inline constexpr std::uint64_t max_text_bytes = std::uint64_t{256} << 20U;
inline constexpr std::uint64_t max_data_bytes = std::uint64_t{4} << 30U;

/// Whole content of a regular file of max_bytes at most. InputError if it is missing, larger, anything else (a folder,
/// a FIFO, a device: none of them is waited for), or cannot be read.
std::string read_file(const std::string& path, std::uint64_t max_bytes = max_text_bytes);

/// InputError unless path is a regular file, or a link to one: for readers that open it themselves.
void require_regular_file(const std::string& path);

}  // namespace odosplat
