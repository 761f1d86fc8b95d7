# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
# cmake -DFILES="a.cl;b.cl" -DOUT=table.cpp -P embed.cmake
# Bytes as numbers rather than a string literal: no limit on length, nothing to escape.
set(arrays "")
set(rows "")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  string(MAKE_C_IDENTIFIER ${name} id)
  file(READ ${file} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(APPEND arrays "const unsigned char ${id}[] = {${bytes}0};\n")
  string(APPEND rows "    {\"${name}\", ${id}, sizeof(${id}) - 1},\n")
endforeach()
file(WRITE ${OUT}.new "#include <stdexcept>
#include <string>

#include \"odosplat/kernels/kernels.hpp\"

namespace odosplat::kernels {
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

std::string_view source(std::string_view name) {
  for (const Row& row : rows) {
    if (name == row.name) return {reinterpret_cast<const char*>(row.text), row.size};
  }
  throw std::logic_error(\"no kernel file is called \" + std::string(name));
}
}  // namespace odosplat::kernels
")
file(COPY_FILE ${OUT}.new ${OUT} ONLY_IF_DIFFERENT)
file(TOUCH ${OUT})
