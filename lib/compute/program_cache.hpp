// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat::compute {

/// Program binaries on disk, one file a key. Private to this folder.
/// A file holds the whole key (so that a hash collision or a foreign file is noticed) and a checksum of the binary.
/// Reading never throws: whatever is wrong with an entry means "not there". Writing failures are ignored: a cache that
/// cannot be written costs time, nothing else. Several processes may use one folder (write beside, then rename).
class ProgramCache {
 public:
  /// folder "" disables the cache.
  explicit ProgramCache(std::string folder) : folder_(std::move(folder)) {}
  /// ODOSPLAT_CACHE_DIR ("off": disabled), else $XDG_CACHE_HOME/odosplat, else $HOME/.cache/odosplat, else disabled.
  static ProgramCache from_environment();

  std::vector<unsigned char> load(const std::string& key) const;
  void store(const std::string& key, const std::vector<unsigned char>& binary) const;
  /// Where the entry of this key lies.
  std::string path(const std::string& key) const;

 private:
  std::string folder_;
};

}  // namespace odosplat::compute
