// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/format/gltf_document.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/io/little_endian.hpp"
#include "odosplat/io/text/json_text.hpp"

namespace odosplat::gltf {
namespace {

using Json = nlohmann::json;

struct Component {
  int type;
  std::size_t size;  // [bytes]
  float largest;     // the value that stands for 1 where they are normalised
};

constexpr Component components[] = {{component_byte, 1, 127.0F},
                                    {component_unsigned_byte, 1, 255.0F},
                                    {component_short, 2, 32767.0F},
                                    {component_unsigned_short, 2, 65535.0F},
                                    {component_float, 4, 1.0F}};

float component_value(const char* at, int type) {
  switch (type) {
    case component_byte:
      return static_cast<float>(load_little<std::int8_t>(at));
    case component_unsigned_byte:
      return static_cast<float>(load_little<std::uint8_t>(at));
    case component_short:
      return static_cast<float>(load_little<std::int16_t>(at));
    case component_unsigned_short:
      return static_cast<float>(load_little<std::uint16_t>(at));
    default:
      return load_little<float>(at);
  }
}

int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

/// False if the text is no base64.
bool decode_base64(std::string_view text, std::string& bytes) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    const int value = base64_value(c);
    if (value < 0) return false;
    bits = bits << 6U | static_cast<std::uint32_t>(value);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<char>((bits >> static_cast<unsigned>(held)) & 0xFFU));
  }
  return true;
}

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// A URI's %20 and the like as characters.
std::string decoded_uri(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool is_code =
        uri[i] == '%' && i + 2 < uri.size() && hex_value(uri[i + 1]) >= 0 && hex_value(uri[i + 2]) >= 0;
    text.push_back(is_code ? static_cast<char>(16 * hex_value(uri[i + 1]) + hex_value(uri[i + 2])) : uri[i]);
    if (is_code) i += 2;
  }
  return text;
}

std::string numbered(const std::string& list, std::size_t index) { return list + "[" + std::to_string(index) + "]"; }

}  // namespace

std::string harmonic_attribute(std::size_t j) {
  std::size_t degree = 0;
  while ((degree + 1) * (degree + 1) <= j) ++degree;
  return "KHR_gaussian_splatting:SH_DEGREE_" + std::to_string(degree) + "_COEF_" + std::to_string(j - degree * degree);
}

Document::Document(std::string name, const std::string& bytes, ReadSibling read_sibling)
    : name_(std::move(name)), read_sibling_(std::move(read_sibling)), stored_(bytes.size()) {
  if (!bytes.starts_with(binary_magic)) {
    json_ = parse_json_object(name_, bytes);
    return;
  }
  if (bytes.size() < binary_header) throw InputError(name_, "is cut off in the header of GLB");
  const auto version = load_little<std::uint32_t>(&bytes[4]);
  if (version != 2) throw InputError(name_, "is glTF of version " + std::to_string(version) + ", must be 2");
  const std::size_t length = load_little<std::uint32_t>(&bytes[8]);
  if (length > bytes.size()) {
    throw InputError(name_,
                     "is cut off: has " + std::to_string(bytes.size()) + " of " + std::to_string(length) + " bytes");
  }
  bool has_json = false;
  for (std::size_t at = binary_header; at < length;) {
    if (length - at < chunk_header) throw InputError(name_, "is damaged: a chunk is cut off");
    const std::size_t size = load_little<std::uint32_t>(&bytes[at]);
    const std::string_view kind = std::string_view(bytes).substr(at + 4, 4);
    at += chunk_header;
    if (size > length - at) throw InputError(name_, "is damaged: a chunk is longer than the file");
    if (kind == json_chunk && !has_json) {
      json_ = parse_json_object(name_, bytes.substr(at, size));
      has_json = true;
    } else if (kind == binary_chunk && !has_binary_) {
      binary_ = bytes.substr(at, size);
      has_binary_ = true;
    }
    at += size;
  }
  if (!has_json) throw InputError(name_, "is damaged: it has no JSON chunk");
}

void Document::fail(const std::string& place, const std::string& fault) const { throw InputError(name_, place, fault); }

std::size_t Document::whole(const Json& object, const char* member, const std::string& place,
                            const std::size_t* fallback) const {
  const auto found = object.find(member);
  if (found == object.end() && fallback != nullptr) return *fallback;
  if (found == object.end() || !found->is_number_integer() || *found < 0) {
    fail(place + "." + member, "must be a whole number of at least 0");
  }
  return found->get<std::size_t>();
}

const Json& Document::element(const char* list, const Json& index, const std::string& from) const {
  const auto found = json_.find(list);
  const std::size_t size = found != json_.end() && found->is_array() ? found->size() : 0;
  if (!index.is_number_integer() || index < 0 || index.get<std::size_t>() >= size) {
    fail(from, "must be the number of one of the " + std::to_string(size) + " elements of " + list);
  }
  const Json& element = (*found)[index.get<std::size_t>()];
  if (!element.is_object()) fail(numbered(list, index.get<std::size_t>()), "must be an object");
  return element;
}

const std::string& Document::buffer(std::size_t index) {
  const auto known = buffers_.find(index);
  if (known != buffers_.end()) return known->second;
  const std::string place = numbered("buffers", index);
  const Json& description = element("buffers", index, place);
  const auto uri = description.find("uri");
  std::string bytes;
  if (uri == description.end()) {
    if (index != 0 || !has_binary_) fail(place, "has no content: the file has no binary chunk for it");
    bytes = std::move(binary_);
  } else {
    if (!uri->is_string()) fail(place + ".uri", "must be text");
    const auto& text = uri->get_ref<const std::string&>();
    if (text.starts_with("data:")) {
      const std::size_t comma = text.find(";base64,");
      if (comma == std::string::npos || !decode_base64(std::string_view(text).substr(comma + 8), bytes)) {
        fail(place + ".uri", "is no base64 data");
      }
    } else {
      bytes = read_sibling_(decoded_uri(text));
      stored_ += bytes.size();
    }
  }
  if (whole(description, "byteLength", place) > bytes.size()) {
    fail(place + ".byteLength", "is larger than the " + std::to_string(bytes.size()) + " bytes that there are");
  }
  return buffers_.emplace(index, std::move(bytes)).first->second;
}

std::string_view Document::view(const Json& index, const std::string& from) {
  const Json& description = element("bufferViews", index, from);
  const std::string place = numbered("bufferViews", index.get<std::size_t>());
  const std::size_t none = 0;
  const std::string_view bytes = buffer(whole(description, "buffer", place));
  const std::size_t begin = whole(description, "byteOffset", place, &none);
  const std::size_t size = whole(description, "byteLength", place);
  if (begin > bytes.size() || size > bytes.size() - begin) fail(place, "reaches beyond its buffer");
  return bytes.substr(begin, size);
}

std::vector<float> Document::accessor(const Json& index, std::size_t width, const std::string& from) {
  const Json& description = element("accessors", index, from);
  const std::string place = numbered("accessors", index.get<std::size_t>());
  if (description.contains("sparse")) fail(place, "is sparse, which is not read");
  if (!description.contains("bufferView")) fail(place, "has no bufferView");
  const std::string type = width == 1 ? "SCALAR" : "VEC" + std::to_string(width);
  if (description.value("type", Json()) != type) fail(place + ".type", "must be " + type);
  const std::size_t none = 0;
  const std::size_t kind = whole(description, "componentType", place);
  const auto component = std::find_if(std::begin(components), std::end(components),
                                      [kind](const Component& c) { return static_cast<std::size_t>(c.type) == kind; });
  if (component == std::end(components)) fail(place + ".componentType", "is not read: " + std::to_string(kind));
  const Json normalized = description.value("normalized", Json(false));
  if (!normalized.is_boolean()) fail(place + ".normalized", "must be true or false");

  const std::string_view bytes = view(description["bufferView"], place + ".bufferView");
  const Json& layout = element("bufferViews", description["bufferView"], place);
  const std::size_t row = width * component->size;
  const std::size_t stride = whole(layout, "byteStride", place, &row);
  const std::size_t begin = whole(description, "byteOffset", place, &none);
  const std::size_t count = whole(description, "count", place);
  if (stride < row) fail(place, "its byteStride is smaller than a value");
  if (begin > bytes.size() ||
      (count > 0 && (bytes.size() - begin < row || (bytes.size() - begin - row) / stride < count - 1))) {
    fail(place + ".count", std::to_string(count) + " values reach beyond the buffer view");
  }
  std::vector<float> values(count * width);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t a = 0; a < width; ++a) {
      const float value = component_value(&bytes[begin + i * stride + a * component->size], component->type);
      values[i * width + a] = normalized.get<bool>() ? std::max(value / component->largest, -1.0F) : value;
    }
  }
  return values;
}

}  // namespace odosplat::gltf
