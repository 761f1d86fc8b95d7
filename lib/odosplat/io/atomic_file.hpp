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

/// synced: the file is on the disk before it takes its place, so that a power cut leaves the old one or the new one.
/// fast: for files that are many and quickly made again, such as rendered images.
enum class Durability { synced, fast };

/// Who the temporary file's name is read by: nobody, or an encoder that tells the format by the extension
/// (given to it in small letters).
enum class TemporaryName { plain, keep_extension };

/// Folders that were made for an output. Those that are empty when it ends are removed: a run that is refused leaves
/// nothing behind.
class MadeFolders {
 public:
  explicit MadeFolders(std::vector<std::string> folders) : folders_(std::move(folders)) {}
  ~MadeFolders();
  MadeFolders(MadeFolders&&) = default;
  MadeFolders& operator=(MadeFolders&&) = delete;
  /// For another program to write into: they stay.
  void keep() { folders_.clear(); }

 private:
  std::vector<std::string> folders_;  // the innermost first
};

/// A file that is written beside its place and renamed at the end: a reader sees the old file or the whole new one,
/// never a part. Missing parent folders are made. A link is written through: the file that it names is replaced, in
/// its own folder; a link that belongs neither to this user nor to root is refused, and so is whatever is there and is
/// no regular file. The new file has the mode of the one that it replaces, and its owner where this user may give it;
/// else what the umask leaves of 0666. Every call throws InputError naming the path and the reason ("cannot be
/// written"). Without commit() the destructor leaves nothing behind. Not thread safe; different files may be written by
/// different threads.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path, TemporaryName name = TemporaryName::plain);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  /// Where the content lies until commit(), for encoders that write by name.
  const std::string& temporary_name() const;
  /// Puts the file in its place. To be called once, after the last write.
  void commit(Durability durability = Durability::synced);

 private:
  [[noreturn]] void fail(const std::string& reason);

  std::string path_;
  std::string target_;  // path_ with its last links resolved
  MadeFolders made_;
  int old_mode_ = -1;  // of the file that is replaced; -1: there is none
  unsigned old_owner_ = 0;
  unsigned old_group_ = 0;
  std::unique_ptr<TemporaryFile> temporary_;
};

/// All of a file at once.
void write_file_atomically(const std::string& path, std::string_view bytes, Durability durability = Durability::synced);

/// Makes the folder (and its parents) if need be and proves that files can be written there. InputError otherwise.
/// Removes temporary files that killed runs left in it. Programs call this before they compute anything and keep what
/// it returns until they have written.
[[nodiscard]] MadeFolders ensure_output_folder(const std::string& path);

/// The same for the folder of a file that will be written later, and for that file's leftovers. InputError also if the
/// file could not be replaced (see AtomicFile).
[[nodiscard]] MadeFolders ensure_output_file(const std::string& path);

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
