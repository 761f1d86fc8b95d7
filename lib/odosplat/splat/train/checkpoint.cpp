// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/train/checkpoint.hpp"

#include <cstdint>
#include <cstring>

#include "odosplat/core/checksum.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat {

namespace {

constexpr std::string_view title = "odosplat checkpoint 1\n";

std::uint64_t checksum(std::string_view bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.value();
}

std::string number(std::uint64_t value) {
  std::string bytes(sizeof(value), '\0');
  std::memcpy(bytes.data(), &value, sizeof(value));
  return bytes;
}

/// Takes a length and as many bytes from the front of `rest`; false if it holds fewer.
bool take(std::string_view& rest, std::string_view& bytes) {
  std::uint64_t length = 0;
  if (rest.size() < sizeof(length)) return false;
  std::memcpy(&length, rest.data(), sizeof(length));
  rest.remove_prefix(sizeof(length));
  if (rest.size() < length) return false;
  bytes = rest.substr(0, length);
  rest.remove_prefix(length);
  return true;
}

}  // namespace

void Checkpoint::fail(const std::string& name, const std::string& fault) const {
  throw InputError(path_, "entry " + name, fault);
}

const std::string& Checkpoint::find(const std::string& name) const {
  const auto found = entries_.find(name);
  if (found == entries_.end()) fail(name, "is missing");
  return found->second;
}

void Checkpoint::put_all(const std::string& prefix, const Checkpoint& other) {
  for (const auto& [name, data] : other.entries_) entries_[prefix + name] = data;
}

Checkpoint Checkpoint::behind(const std::string& prefix) const {
  Checkpoint part;
  part.path_ = path_;
  for (const auto& [name, data] : entries_)
    if (name.starts_with(prefix)) part.entries_[name.substr(prefix.size())] = data;
  return part;
}

void Checkpoint::write(const std::string& path) const {
  std::string bytes(title);
  for (const auto& [name, data] : entries_) {
    bytes += number(name.size());
    bytes += name;
    bytes += number(data.size());
    bytes += data;
  }
  bytes += number(checksum(bytes));
  write_file_atomically(path, bytes);
}

Checkpoint Checkpoint::read(const std::string& path) {
  const std::string bytes = read_file(path, max_data_bytes);
  if (!bytes.starts_with(title)) throw InputError(path, "is no checkpoint of this version of odosplat");
  std::uint64_t stored = 0;
  if (bytes.size() < title.size() + sizeof(stored)) throw InputError(path, "is cut short");
  const std::string_view content(bytes.data(), bytes.size() - sizeof(stored));
  std::memcpy(&stored, bytes.data() + content.size(), sizeof(stored));
  if (stored != checksum(content)) throw InputError(path, "is damaged: its checksum does not fit");
  Checkpoint checkpoint;
  checkpoint.path_ = path;
  std::string_view rest = content.substr(title.size());
  while (!rest.empty()) {
    std::string_view name;
    std::string_view data;
    if (!take(rest, name) || !take(rest, data)) throw InputError(path, "is damaged: an entry is cut short");
    checkpoint.put_bytes(std::string(name), data);
  }
  return checkpoint;
}

}  // namespace odosplat
