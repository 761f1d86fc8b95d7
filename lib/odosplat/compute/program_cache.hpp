// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat::compute {

/// Program binaries on disk, one file a key. Private to this folder.
/// Binaries are run as they are found, so the folder and its files count only if they belong to this user and nobody
/// else may write to them; files must be regular ones, not links. A file holds the whole key, which is compared (its
/// name is only a short hash of it), and the binary's length and checksum, which tell damage and not forgery.
/// Reading never throws: whatever is wrong with an entry means "not there". Writing failures are ignored: a cache that
/// cannot be written costs time, nothing else. Several processes may use one folder (write beside, then rename).
class ProgramCache {
 public:
  /// folder "" disables the cache.
  explicit ProgramCache(std::string folder) : folder_(std::move(folder)) {}
  /// ODOSPLAT_CACHE_DIR/kernels ("off": disabled), else $XDG_CACHE_HOME/odosplat/kernels, else
  /// $HOME/.cache/odosplat/kernels, else disabled.
  static ProgramCache from_environment();

  std::vector<unsigned char> load(const std::string& key) const;
  /// Makes the folder if need be, for this user alone.
  void store(const std::string& key, const std::vector<unsigned char>& binary) const;
  /// Why the folder is not used, in a line; empty: it is, or is not there yet, or is disabled.
  std::string fault() const;

 private:
  std::string folder_;
};

/// The same of the cache that PoCL keeps by itself (POCL_CACHE_DIR, else $XDG_CACHE_HOME/pocl/kcache, else
/// $HOME/.cache/pocl/kcache, else /tmp/pocl/kcache), and runs kernels from without asking whose they are: why it must
/// not be used, in a line; empty: it may. Its group may write to it: PoCL makes it as the umask has it.
std::string pocl_cache_fault();

}  // namespace odosplat::compute
