// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/view/web/web_page.hpp"

#include <zlib.h>

#include <stdexcept>

#include "apps/command/html_text.hpp"
#include "apps/command/json_text.hpp"
#include "odosplat/core/base64.hpp"

namespace odosplat::apps {
namespace {

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), Z_BEST_COMPRESSION) != Z_OK) {
    throw std::runtime_error("zlib cannot compress the page's data");
  }
  packed.resize(size);
  return packed;
}

std::string value_of(const WebPage& page, std::string_view name) {
  if (name == "title") return html_escaped(page.title);
  if (name == "data") return json_for_html(json_text(page.data, -1));
  if (name == "map") return page.map;
  if (name == "numbers") return page.numbers;
  const auto file = page_texts().find(name);
  if (file == page_texts().end()) throw std::logic_error("page.html names " + std::string(name));
  return std::string(file->second);
}

}  // namespace

std::string page_block(const std::string& bytes) { return base64(deflated(bytes)); }

std::string html_of(const WebPage& page) {
  std::string_view rest = page_texts().at("page.html");
  std::string html;
  for (std::size_t at = rest.find("{{"); at != std::string_view::npos; at = rest.find("{{")) {
    const std::size_t end = rest.find("}}", at);
    html += rest.substr(0, at);
    html += value_of(page, rest.substr(at + 2, end - at - 2));
    rest.remove_prefix(end + 2);
  }
  return html += rest;
}

}  // namespace odosplat::apps
