// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Rules for the whole source tree: allowed dependencies (CONTRIBUTING.md's table, compared with CMake's link lines and
// all includes), paths of includes, names of types, sizes of folders, licences, and which files write to the terminal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/house/repository.hpp"

namespace {

using namespace odosplat::test::house;
using Names = std::set<std::string>;

struct Room {
  std::string folder;
  Names rooms;      // other folders that it may use
  Names libraries;  // external libraries that it may use: first part of their include paths
};

std::vector<std::string> columns_of(const std::string& row) {
  std::vector<std::string> columns;
  std::istringstream in(row);
  for (std::string cell; std::getline(in, cell, '|');) columns.push_back(cell);
  return columns;
}

Names words_of(const std::string& cell) {
  static const std::regex word(R"re([\w/-]*\w[\w/-]*)re");
  Names words;
  for (std::sregex_iterator it(cell.begin(), cell.end(), word), end; it != end; ++it) words.insert(it->str());
  return words;
}

// The table of CONTRIBUTING.md by the last parts of the folders' names.
const std::map<std::string, Room>& house() {
  static const std::map<std::string, Room> rooms = [] {
    std::map<std::string, Room> found;
    std::istringstream in(text_of(root / "CONTRIBUTING.md"));
    static const std::regex first(R"re(\| `([\w/]+)` \|.*)re");
    for (std::string line; std::getline(in, line);) {
      std::smatch match;
      const std::vector<std::string> columns = columns_of(line);
      if (columns.size() < 5 || !std::regex_match(line, match, first)) continue;
      const std::string folder = match[1];
      found[folder.substr(folder.rfind('/') + 1)] = {folder, words_of(columns[3]), words_of(columns[4])};
    }
    return found;
  }();
  return rooms;
}

bool is_source(const fs::path& file) { return file.extension() == ".cpp" || file.extension() == ".hpp"; }

std::vector<fs::path> sources_in(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    if (is_source(entry.path())) files.push_back(entry.path());
  }
  return files;
}

const char* const code_folders[] = {"kernels", "lib", "viewer", "apps"};

std::vector<std::string> includes_of(const std::string& text) {
  static const std::regex line(R"re(#\s*include\s*[<"]([^>"]+)[>"])re");
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), line), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

// The library's name as in the table; "" for the standard library and POSIX.
std::string library_of(const std::string& include) {
  static const std::regex foreign(
      R"re((Eigen|opencv2/\w+|ceres|libav\w+|libsw\w+|CL|EGL|GL|spdlog|yaml-cpp|nlohmann|pybind11|tbb|zlib|zstd|CLI|gtest|gmock)[/.].*)re");
  std::smatch match;
  if (std::regex_match(include, match, foreign)) return match[1];
  if (include.rfind("nanoflann", 0) == 0) return "nanoflann";
  if (include.rfind("vtk", 0) == 0) return "vtk";
  return "";
}

std::vector<std::string> quoted_includes_of(const std::string& text) {
  static const std::regex line(R"re((?:^|\n)\s*#\s*include\s*"([^"]+)")re");
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), line), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

// Folder in the table for a path from the repository or an include; "" for none.
std::string room_of(const std::string& path) {
  static const std::regex own(R"re((?:lib/)?odosplat/(\w+)/.*|apps/(python)/.*|(viewer|kernels|apps)/.*)re");
  std::smatch match;
  if (!std::regex_match(path, match, own)) return "";
  for (std::size_t k = 1; k < 3; ++k) {
    if (match[k].matched) return match[k];
  }
  return match[3];
}

TEST(House, TheTableNamesEveryFolder) {
  ASSERT_GE(house().size(), 13U);
  for (const auto& [name, room] : house()) {
    EXPECT_TRUE(fs::is_directory(root / room.folder)) << room.folder;
    for (const std::string& other : room.rooms) EXPECT_EQ(house().count(other), 1U) << name << " may use " << other;
  }
  for (const auto& entry : fs::directory_iterator(root / "lib/odosplat")) {
    EXPECT_TRUE(house().count(entry.path().filename()) == 1) << entry.path();
  }
}

TEST(House, IncludesKeepToTheTable) {
  int own = 0;
  for (const auto& [name, room] : house()) {
    for (const fs::path& file : sources_in(room.folder)) {
      if (room_of(fs::relative(file, root)) != name) continue;  // of a room within this one
      for (const std::string& include : includes_of(text_of(file))) {
        EXPECT_FALSE(include.starts_with("tests/")) << file << " includes " << include;
        if (const std::string target = room_of(include); !target.empty()) {
          EXPECT_TRUE(target == name || room.rooms.count(target) == 1) << file << " includes " << include;
          ++own;
        } else if (const std::string library = library_of(include); !library.empty()) {
          EXPECT_TRUE(room.libraries.count(library) == 1) << file << " includes " << include;
        }
      }
    }
  }
  EXPECT_GT(own, 1000);
}

// The path of an include is the path of its file, so that editors find it before anything is configured.
TEST(House, IncludesResolveInTheRepository) {
  for (const char* folder : {"kernels", "lib", "viewer", "apps", "tests"}) {
    for (const fs::path& file : sources_in(folder)) {
      for (const std::string& include : quoted_includes_of(text_of(file))) {
        EXPECT_FALSE(file_of(include).empty()) << file << " includes " << include;
      }
    }
  }
  const std::string flags = text_of(root / "compile_flags.txt");
  EXPECT_NE(flags.find("-Ilib\n-I.\n"), std::string::npos);
}

// A header and its source file are one module. Modules must not include each other in a circle: they should be merged,
// or their common part be moved to a third.
TEST(House, IncludesMakeNoCircle) {
  std::map<std::string, Names> needs;  // by path without extension
  for (const char* folder : code_folders) {
    for (const fs::path& file : sources_in(folder)) {
      // Private to its folder: it declares what several source files define.
      if (file.filename() == "opencl.hpp") continue;
      const std::string module = fs::path(file).replace_extension();
      for (const std::string& include : quoted_includes_of(text_of(file))) {
        const std::string other = file_of(include).replace_extension();
        if (other != module) needs[module].insert(other);
      }
    }
  }
  // Repeatedly removes the modules that need none of the remaining ones. Those left are in a circle or need one that is.
  for (bool changed = true; changed;) {
    changed = false;
    for (auto it = needs.begin(); it != needs.end();) {
      const bool waits = std::any_of(it->second.begin(), it->second.end(),
                                     [&](const std::string& other) { return needs.count(other) == 1; });
      it = waits ? std::next(it) : needs.erase(it);
      changed = changed || !waits;
    }
  }
  for (const auto& [module, others] : needs) ADD_FAILURE() << module << " is in a circle of includes, or needs one";
}

TEST(House, LinksKeepToTheTable) {
  const std::string cmake = text_of(root / "lib/CMakeLists.txt") + text_of(root / "viewer/CMakeLists.txt");
  static const std::regex call(R"re(odosplat_(?:own_)?library\((\w+) ([^)]*)\))re");
  static const std::regex dependency(R"re(odosplat(?:_|::)(\w+))re");
  std::size_t libraries = 0;
  for (std::sregex_iterator it(cmake.begin(), cmake.end(), call), end; it != end; ++it, ++libraries) {
    const std::string name = (*it)[1];
    const std::string arguments = (*it)[2];
    ASSERT_EQ(house().count(name), 1U) << name << " is not in the table";
    for (std::sregex_iterator d(arguments.begin(), arguments.end(), dependency); d != end; ++d) {
      EXPECT_EQ(house().at(name).rooms.count((*d)[1]), 1U) << name << " links " << (*d)[1];
    }
  }
  EXPECT_EQ(libraries, house().size() - 3) << "every room but kernels, apps and apps/python is declared there";
}

TEST(House, FoldersHoldAtMost15Sources) {
  for (const char* folder : {"lib", "viewer", "apps", "tests"}) {
    std::map<std::string, int> sources;
    for (const fs::path& file : sources_in(folder)) {
      if (file.extension() == ".cpp") ++sources[file.parent_path()];
    }
    for (const auto& [name, count] : sources) EXPECT_LE(count, 15) << name;
  }
}

// The text without comments, strings and characters, since these may contain braces and keywords.
std::string bare(const std::string& text) {
  std::string kept;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto starts = [&](const char* word) { return text.compare(i, std::strlen(word), word) == 0; };
    std::size_t last = std::string::npos;  // last character of the part left out
    if (starts("//")) {
      last = text.find('\n', i);
    } else if (starts("/*")) {
      last = text.find("*/", i + 2) + 1;
    } else if (starts("R\"")) {
      const std::string mark = text.substr(i + 2, text.find('(', i) - i - 2);
      last = text.find(")" + mark + "\"", i) + mark.size() + 1;
    } else if (text[i] == '"' || (text[i] == '\'' && (i == 0 || std::isalnum(text[i - 1]) == 0))) {
      for (last = i + 1; last < text.size() && text[last] != text[i]; ++last) last += text[last] == '\\' ? 1 : 0;
    } else {
      kept += text[i];
      continue;
    }
    kept += ' ';
    if (last >= text.size()) break;
    i = last;
  }
  return kept;
}

// Qualified names of the types and inline constants that a file defines, except within functions, types and unnamed namespaces.
std::vector<std::string> names_defined_in(const std::string& text) {
  static const std::regex token(
      R"re(\bnamespace\s*([\w:]*)\s*\{|\b(?:struct|class|enum class|enum|union)\s+(?:alignas\([^)]*\)\s*)?([\w:]+)[^;{}()=<>]*(?:<[^;{}()]*)?\{|\binline\s+constexpr\s+[^;{}()=]*?\b(\w+)(?=\s*(?:\[\w*\])?\s*[={])|\{|\})re");
  std::vector<std::string> scopes;  // "" for a scope whose types are not counted
  std::vector<std::string> found;
  const std::string code = bare(text);
  for (std::sregex_iterator it(code.begin(), code.end(), token), end; it != end; ++it) {
    const std::string whole = it->str();
    if (whole == "}") {
      if (!scopes.empty()) scopes.pop_back();
      continue;
    }
    std::string path;
    bool counted = true;
    for (const std::string& scope : scopes) {
      counted = counted && !scope.empty();
      path += scope + "::";
    }
    const std::string name = (*it)[2].matched ? it->str(2) : it->str(3);
    if (!name.empty() && counted && !scopes.empty()) found.push_back(path + name);
    if ((*it)[3].matched) continue;
    scopes.push_back((*it)[1].matched ? it->str(1) : "");
  }
  return found;
}

TEST(House, FindsNamesOnlyWhereTheyAreDefinedForAll) {
  EXPECT_THAT(
      names_defined_in(
          "struct Outside {}; namespace a::b { // struct No {\n struct alignas(64) One : Base<int> { struct In {}; };"
          "template <class Row> void f(Row) { struct Local {}; } class Two; enum class Three { x };"
          "namespace { struct Four {}; } const char* text = \"struct Five {\"; class Six final {}; "
          "inline constexpr int seven = 7; inline constexpr std::array<int, 2> eight{1, 2}; constexpr int no = 0;"
          "inline constexpr char nine[] = {}; void g() { inline constexpr int no = 1; } }"),
      testing::ElementsAre("a::b::One", "a::b::Three", "a::b::Six", "a::b::seven", "a::b::eight", "a::b::nine"));
}

// Two types or inline constants with the same name in one program are undefined behaviour, even in different libraries.
TEST(House, NamesAreUnique) {
  std::map<std::string, std::string> places;
  for (const char* folder : code_folders) {
    for (const fs::path& file : sources_in(folder)) {
      for (const std::string& name : names_defined_in(text_of(file))) {
        const auto [place, added] = places.emplace(name, file.string());
        EXPECT_TRUE(added) << name << " is defined in " << place->second << " and in " << file;
      }
    }
  }
  EXPECT_GT(places.size(), 300U);
}

TEST(House, ModulesDoNotKnowTheOdometry) {
  for (const fs::path& file : sources_in("lib/odosplat/odometry")) {
    if (file.stem() == "odometry") continue;
    for (const std::string& include : includes_of(text_of(file))) {
      EXPECT_NE(include, "odosplat/odometry/odometry.hpp") << file << ": modules do not know the whole";
    }
  }
}

// Text from files must be escaped before it is written to a terminal: only these files write to it. The example of a
// user's program is an exception.
TEST(House, StandardStreamsAreWrittenInFewPlaces) {
  const Names places{"apps/command/output.cpp",    "apps/command/support.cpp",      "apps/command/run_program.cpp",
                     "apps/command/interrupt.cpp", "apps/example/track_images.cpp", "lib/odosplat/core/progress.cpp"};
  for (const char* folder : {"apps", "lib", "viewer"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string name = fs::relative(entry.path(), root).string();
      if (entry.path().extension() != ".cpp" || places.count(name) > 0) continue;
      const std::string text = text_of(entry.path());
      for (const char* way :
           {"std::printf", "std::puts", "std::fprintf(std", "std::fputs(", "std::cout", "std::cerr"}) {
        EXPECT_EQ(text.find(way), std::string::npos) << name << " uses " << way << "; use print or the log";
      }
    }
  }
}

TEST(House, EveryFileNamesItsLicence) {
  for (const char* folder : {"lib", "viewer", "apps", "kernels", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".cpp" && extension != ".hpp" && extension != ".cl" && extension != ".h") continue;
      EXPECT_NE(text_of(entry.path()).substr(0, 120).find("SPDX-License-Identifier: Apache-2.0"), std::string::npos)
          << entry.path();
    }
  }
}

}  // namespace
