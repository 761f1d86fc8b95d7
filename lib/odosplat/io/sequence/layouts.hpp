// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/io/sequence/sequence_index.hpp"
#include "odosplat/io/sequence/sequence_options.hpp"

namespace odosplat {

struct Layout {
  const char* name;
  const char* signature;  // the files by which it is recognised, for errors
  bool (*matches)(const std::string& path);
  SequenceIndex (*index)(const std::string& path, const SequenceOptions& options);
};

/// All layouts, in the order in which detection tries them.
const std::vector<Layout>& layouts();

/// Throws InputError if there is no layout of this name.
const Layout& layout_named(const std::string& name);

/// The first layout that a path matches. Throws InputError if there is none.
const Layout& detect_layout(const std::string& path);

bool is_tum(const std::string& path);
bool is_icl(const std::string& path);
bool is_redwood(const std::string& path);
bool is_sevenscenes(const std::string& path);
bool is_replica(const std::string& path);
bool is_colmap(const std::string& path);
bool is_nerfstudio(const std::string& path);
/// True for a file NAME.json.
bool is_transforms(const std::string& path);
bool is_image_folder(const std::string& path);
bool is_video(const std::string& path);
SequenceIndex index_tum(const std::string& path, const SequenceOptions& options);
SequenceIndex index_icl(const std::string& path, const SequenceOptions& options);
SequenceIndex index_redwood(const std::string& path, const SequenceOptions& options);
SequenceIndex index_sevenscenes(const std::string& path, const SequenceOptions& options);
SequenceIndex index_replica(const std::string& path, const SequenceOptions& options);
SequenceIndex index_colmap(const std::string& path, const SequenceOptions& options);
SequenceIndex index_nerfstudio(const std::string& path, const SequenceOptions& options);
SequenceIndex index_image_folder(const std::string& path, const SequenceOptions& options);
SequenceIndex index_video(const std::string& path, const SequenceOptions& options);

}  // namespace odosplat
