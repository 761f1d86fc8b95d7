# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
# cmake -DFILES="a.cl;b.cl" -DNAMESPACE=odosplat -DFUNCTION=texts -DOUT=texts.cpp -P embed_texts.cmake
# Bytes as numbers rather than a string literal: no limit on length, nothing to escape.
set(arrays "")
set(rows "")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  string(MAKE_C_IDENTIFIER ${name} id)
  file(READ ${file} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(APPEND arrays "const unsigned char ${id}[] = {${bytes}0};\n")
  string(APPEND rows "      {\"${name}\", {reinterpret_cast<const char*>(${id}), sizeof(${id}) - 1}},\n")
endforeach()
file(WRITE ${OUT} "#include <map>
#include <string_view>

namespace ${NAMESPACE} {
namespace {
${arrays}
}  // namespace

const std::map<std::string_view, std::string_view>& ${FUNCTION}();
const std::map<std::string_view, std::string_view>& ${FUNCTION}() {
  static const std::map<std::string_view, std::string_view> texts{
${rows}  };
  return texts;
}
}  // namespace ${NAMESPACE}
")
