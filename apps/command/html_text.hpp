// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <string_view>

/// Text and data for HTML files.
namespace odosplat::apps {

/// The text with & < > " ' as character references: safe as content of an element and as value of an attribute.
std::string html_escaped(std::string_view text);

/// JSON for a script element: < > & as \u003c and so on, so that no string in it ends the element or begins a comment.
/// The JSON must be valid.
std::string json_for_html(std::string_view json);

}  // namespace odosplat::apps
