// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/compute/program_cache.hpp"

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace odosplat::compute {
namespace {

constexpr char magic[8] = {'o', 's', 'p', 'l', 'a', 't', '0', '1'};

// FNV-1a, 64 bits.
std::uint64_t hash(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::uint64_t h = 0xcbf29ce484222325ULL;
  for (std::size_t i = 0; i < size; ++i) h = (h ^ bytes[i]) * 0x100000001b3ULL;
  return h;
}

struct Header {
  char magic[8];
  std::uint64_t key_size;
  std::uint64_t binary_size;
  std::uint64_t binary_hash;
};

}  // namespace

ProgramCache ProgramCache::from_environment() {
  if (const char* folder = std::getenv("ODOSPLAT_CACHE_DIR")) {
    return ProgramCache(std::strcmp(folder, "off") == 0 ? "" : folder);
  }
  if (const char* folder = std::getenv("XDG_CACHE_HOME")) return ProgramCache(std::string(folder) + "/odosplat");
  if (const char* home = std::getenv("HOME")) return ProgramCache(std::string(home) + "/.cache/odosplat");
  return ProgramCache("");
}

std::string ProgramCache::path(const std::string& key) const {
  char name[40];
  std::snprintf(name, sizeof(name), "/%016llx.bin", static_cast<unsigned long long>(hash(key.data(), key.size())));
  return folder_ + name;
}

std::vector<unsigned char> ProgramCache::load(const std::string& key) const {
  if (folder_.empty()) return {};
  std::ifstream file(path(key), std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  Header header{};
  if (content.size() < sizeof(header)) return {};
  std::memcpy(&header, content.data(), sizeof(header));
  if (std::memcmp(header.magic, magic, sizeof(magic)) != 0 || header.key_size != key.size() ||
      content.size() - sizeof(header) < key.size() ||
      content.size() - sizeof(header) - key.size() != header.binary_size ||
      content.compare(sizeof(header), key.size(), key) != 0) {
    return {};
  }
  const char* binary = content.data() + sizeof(header) + key.size();
  if (hash(binary, header.binary_size) != header.binary_hash) return {};
  return {binary, binary + header.binary_size};
}

void ProgramCache::store(const std::string& key, const std::vector<unsigned char>& binary) const {
  if (folder_.empty() || binary.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  const std::string target = path(key);
  const std::string beside = target + "." + std::to_string(getpid());
  {
    Header header{};
    std::memcpy(header.magic, magic, sizeof(magic));
    header.key_size = key.size();
    header.binary_size = binary.size();
    header.binary_hash = hash(binary.data(), binary.size());
    std::ofstream file(beside, std::ios::binary);
    file.write(reinterpret_cast<const char*>(&header), sizeof(header));
    file.write(key.data(), static_cast<std::streamsize>(key.size()));
    file.write(reinterpret_cast<const char*>(binary.data()), static_cast<std::streamsize>(binary.size()));
    if (!file.flush()) {
      std::filesystem::remove(beside, error);
      return;
    }
  }
  std::filesystem::rename(beside, target, error);
  if (error) std::filesystem::remove(beside, error);
}

}  // namespace odosplat::compute
