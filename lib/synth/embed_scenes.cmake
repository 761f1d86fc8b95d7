# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
# cmake -DFILES="a.yaml;b.yaml" -DOUT=table.cpp -P embed_scenes.cmake
# Bytes as numbers rather than a string literal: no limit on length, nothing to escape.
set(arrays "")
set(rows "")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(APPEND arrays "const unsigned char ${name}[] = {${bytes}0};\n")
  string(APPEND rows "    {\"${name}\", ${name}, sizeof(${name}) - 1},\n")
endforeach()
file(WRITE ${OUT}.new "#include \"odosplat/core/error.hpp\"
#include \"odosplat/synth/scene_description.hpp\"

namespace odosplat {
namespace {
${arrays}
struct Row {
  const char* name;
  const unsigned char* text;
  std::size_t size;
};
const Row rows[] = {
${rows}};
}  // namespace

std::vector<std::string> built_in_scenes() {
  std::vector<std::string> names;
  for (const Row& row : rows) names.emplace_back(row.name);
  return names;
}

std::string_view built_in_scene_text(const std::string& name) {
  std::string names;
  for (const Row& row : rows) {
    if (name == row.name) return {reinterpret_cast<const char*>(row.text), row.size};
    names += (names.empty() ? \"\" : \", \") + std::string(row.name);
  }
  throw InputError(name, \"is no built-in scene: there are \" + names);
}
}  // namespace odosplat
")
file(COPY_FILE ${OUT}.new ${OUT} ONLY_IF_DIFFERENT)
file(TOUCH ${OUT})
