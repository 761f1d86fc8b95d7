// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace odosplat {

/// Named arrays of bytes in one file: what a training run needs to go on as if it had not stopped. Numbers are written
/// as this machine holds them; a checkpoint is for the machine and the program version that wrote it, not for exchange.
/// File: the line "odosplat checkpoint 1", entries (length of name, name, length of data, data), a checksum of all
/// before it (FNV-1a, 64 bit). Not thread safe.
class Checkpoint {
 public:
  /// T: a plain type.
  template <typename T>
  void put(const std::string& name, const std::vector<T>& values) {
    put_bytes(name, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
  }
  void put_text(const std::string& name, const std::string& text) { put_bytes(name, text); }

  /// InputError if there is no such entry, or its size is no multiple of the element's.
  template <typename T>
  std::vector<T> get(const std::string& name) const {
    const std::string& bytes = find(name);
    if (bytes.size() % sizeof(T) != 0) fail(name, "has another type");
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) bytes.copy(reinterpret_cast<char*>(values.data()), bytes.size());
    return values;
  }
  std::string get_text(const std::string& name) const { return find(name); }

  /// put_all adds all entries of another checkpoint, with `prefix` before their names; behind gives these back, without
  /// it.
  void put_all(const std::string& prefix, const Checkpoint& other);
  Checkpoint behind(const std::string& prefix) const;
  bool empty() const { return entries_.empty(); }

  /// Written beside its place and renamed: a run that is killed meanwhile leaves the one before. InputError if it
  /// cannot be written.
  void write(const std::string& path) const;
  /// InputError naming file and fault: missing, no checkpoint, cut short, damaged.
  static Checkpoint read(const std::string& path);

 private:
  void put_bytes(const std::string& name, std::string_view bytes) { entries_[name] = std::string(bytes); }
  const std::string& find(const std::string& name) const;
  [[noreturn]] void fail(const std::string& name, const std::string& fault) const;

  std::string path_ = "checkpoint";
  std::map<std::string, std::string> entries_;
};

}  // namespace odosplat
