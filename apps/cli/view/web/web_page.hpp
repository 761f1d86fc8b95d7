// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace odosplat::apps {

/// The files of the folder page/, as they were at build time, by name.
const std::map<std::string_view, std::string_view>& page_texts();

/// What a page shows; formats: PackedMap, PageNumbers, json_of_run and json_of_truth, and apps/cli/view/web/page/data.js.
struct WebPage {
  std::string title;
  nlohmann::ordered_json data;
  std::string map;      // page_block of PackedMap::bytes
  std::string numbers;  // page_block of PageNumbers::bytes
};

/// Bytes as the page holds them: compressed in zlib's format (RFC 1950), which browsers call deflate, in base64.
std::string page_block(const std::string& bytes);

/// One HTML file that needs nothing else. It is made of page.html, in which {{NAME}} stands for the file NAME, or for
/// title, data, map or numbers. Text and JSON are escaped: no name in them can end or begin an element.
std::string html_of(const WebPage& page);

}  // namespace odosplat::apps
