// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud/ply.hpp"

#include <stdexcept>

#include "odosplat/core/error.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

std::size_t length(const PlyColumn& column) {
  return std::visit([](const auto& values) { return values.size(); }, column);
}

}  // namespace

const PlyColumn* PlyElement::find(const std::string& property) const {
  for (const PlyProperty& p : properties) {
    if (p.name == property) return &p.values;
  }
  for (const PlyProperty& p : properties) {
    if (same_word(p.name, property)) return &p.values;
  }
  return nullptr;
}

void PlyElement::add(const std::string& property, PlyColumn values) {
  if (properties.empty()) count = length(values);
  if (length(values) != count) throw std::invalid_argument("PLY column " + property + " differs in length");
  properties.push_back({property, std::move(values)});
}

bool Ply::has(const std::string& element_name) const {
  for (const PlyElement& e : elements) {
    if (same_word(e.name, element_name)) return true;
  }
  return false;
}

const PlyElement& Ply::element(const std::string& element_name) const {
  for (const PlyElement& e : elements) {
    if (same_word(e.name, element_name)) return e;
  }
  throw InputError(file, "has no element " + element_name);
}

const PlyColumn& Ply::values_of(const std::string& element_name, const std::string& property) const {
  const PlyColumn* values = element(element_name).find(property);
  if (values == nullptr) throw InputError(file, element_name, "has no property " + property);
  return *values;
}

}  // namespace odosplat
