// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat::compute {

/// Program binaries on disk, one file per key. Private to this folder.
/// Binaries are executed without further checks, so the folder and its files are used only if they belong to this user
/// and nobody else may write to them; files must be regular files, not links. A file contains the whole key, which is
/// compared because the file name is only a short hash of it, and the binary's length and checksum, which detect damage
/// but not forgery. Reading never throws: any fault of an entry counts as "not there". Write errors are ignored:
/// without the cache programs only take longer to start. Several processes may use one folder: a file is written under
/// a temporary name and then renamed.
class ProgramCache {
 public:
  /// folder "" disables the cache.
  explicit ProgramCache(std::string folder) : folder_(std::move(folder)) {}
  /// ODOSPLAT_CACHE_DIR/kernels ("off": disabled), else $XDG_CACHE_HOME/odosplat/kernels, else
  /// $HOME/.cache/odosplat/kernels, else disabled.
  static ProgramCache from_environment();

  std::vector<unsigned char> load(const std::string& key) const;
  /// Creates the folder if it is missing, accessible to this user only.
  void store(const std::string& key, const std::vector<unsigned char>& binary) const;
  /// Why the folder is not used, in one line; empty if it is used, does not exist yet, or the cache is disabled.
  std::string fault() const;

 private:
  std::string folder_;
};

/// The same check for PoCL's own cache folder (POCL_CACHE_DIR, else $XDG_CACHE_HOME/pocl/kcache, else
/// $HOME/.cache/pocl/kcache, else /tmp/pocl/kcache), from which PoCL runs kernels without checking their owner: why it
/// must not be used, in one line; empty if it may be. Write permission for the group is accepted, because PoCL creates
/// the folder with the permissions that the umask leaves.
std::string pocl_cache_fault();

}  // namespace odosplat::compute
