// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Who may depend on whom: the link lines of CMake and every include, held against the one table below. CONTRIBUTING.md
// shows the same table to people.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "locations.hpp"

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

const fs::path root = odosplat::test::source_dir();

struct Room {
  std::string folder;
  Names rooms;      // other rooms it may use
  Names libraries;  // first part of the include paths of foreign libraries it may use
};

const std::map<std::string, Room> house{
    {"kernels", {"kernels", {}, {}}},
    {"core", {"lib/core", {}, {"Eigen", "opencv2/core", "opencv2/imgproc", "spdlog"}}},
    {"compute", {"lib/compute", {"kernels"}, {"CL", "spdlog"}}},
    {"io",
     {"lib/io",
      {"core"},
      {"Eigen", "opencv2/core", "opencv2/imgproc", "opencv2/imgcodecs", "opencv2/videoio", "libavcodec", "libavformat",
       "libavutil", "libswscale", "yaml-cpp", "nlohmann", "spdlog"}}},
    {"map", {"lib/map", {"core"}, {"Eigen", "opencv2/core", "opencv2/imgproc", "nanoflann"}}},
    {"splat", {"lib/splat", {"core", "compute", "map", "kernels", "io"}, {"Eigen", "opencv2/core", "opencv2/imgproc"}}},
    {"odometry",
     {"lib/odometry",
      {"core", "map"},
      {"Eigen", "opencv2/core", "opencv2/imgproc", "opencv2/features2d", "opencv2/calib3d"}}},
    {"eval", {"lib/eval", {"core"}, {"Eigen", "opencv2/core", "opencv2/imgproc"}}},
    {"synth", {"lib/synth", {"core", "map"}, {"Eigen", "opencv2/core", "opencv2/imgproc", "yaml-cpp"}}},
    {"viewer", {"viewer", {"core", "map", "eval"}, {"Eigen", "opencv2/core", "opencv2/imgproc", "vtk", "EGL", "GL"}}},
};

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> sources_of(const Room& room) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root / room.folder)) {
    const std::string extension = entry.path().extension();
    if (extension == ".cpp" || extension == ".hpp") files.push_back(entry.path());
  }
  return files;
}

std::vector<std::string> includes_of(const std::string& text) {
  static const std::regex line(R"re(#\s*include\s*[<"]([^>"]+)[>"])re");
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), line), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

// "" for the standard library and POSIX, else the library's name as the table has it.
std::string library_of(const std::string& include) {
  static const std::regex foreign(
      R"re((Eigen|opencv2/\w+|ceres|libav\w+|libsw\w+|CL|EGL|GL|spdlog|yaml-cpp|nlohmann|tbb|CLI|gtest|gmock)[/.].*)re");
  std::smatch match;
  if (std::regex_match(include, match, foreign)) return match[1];
  if (include.rfind("nanoflann", 0) == 0) return "nanoflann";
  if (include.rfind("vtk", 0) == 0) return "vtk";
  return "";
}

TEST(House, IncludesKeepToTheTable) {
  for (const auto& [name, room] : house) {
    for (const fs::path& file : sources_of(room)) {
      for (const std::string& include : includes_of(text_of(file))) {
        static const std::regex own(R"re(odosplat/(\w+)/.*)re");
        std::smatch match;
        if (std::regex_match(include, match, own)) {
          const std::string target = match[1];
          EXPECT_TRUE(target == name || room.rooms.count(target) == 1) << file << " includes " << include;
        } else if (const std::string library = library_of(include); !library.empty()) {
          EXPECT_TRUE(room.libraries.count(library) == 1) << file << " includes " << include;
        }
      }
    }
  }
}

TEST(House, LinksKeepToTheTable) {
  const std::string cmake = text_of(root / "lib/CMakeLists.txt") + text_of(root / "viewer/CMakeLists.txt");
  static const std::regex call(R"re(odosplat_library\((\w+) ([^)]*)\))re");
  static const std::regex dependency(R"re(odosplat_(\w+))re");
  int libraries = 0;
  for (std::sregex_iterator it(cmake.begin(), cmake.end(), call), end; it != end; ++it, ++libraries) {
    const std::string name = (*it)[1];
    const std::string arguments = (*it)[2];
    ASSERT_EQ(house.count(name), 1U) << name << " is not in the table";
    for (std::sregex_iterator d(arguments.begin(), arguments.end(), dependency); d != end; ++d) {
      EXPECT_EQ(house.at(name).rooms.count((*d)[1]), 1U) << name << " links " << (*d)[1];
    }
  }
  EXPECT_EQ(libraries, static_cast<int>(house.size()) - 1) << "every room but kernels is declared there";
}

// The text without comments, strings and characters, which may hold braces and words.
std::string bare(const std::string& text) {
  std::string kept;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto starts = [&](const char* word) { return text.compare(i, std::strlen(word), word) == 0; };
    std::size_t last = std::string::npos;  // of what is left out
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

// Names, with their namespaces, of the types that a file defines outside functions, types and unnamed namespaces.
std::vector<std::string> types_defined_in(const std::string& text) {
  static const std::regex token(
      R"re(\bnamespace\s*([\w:]*)\s*\{|\b(?:struct|class|enum class|enum|union)\s+(?:alignas\([^)]*\)\s*)?([\w:]+)[^;{}()=<>]*(?:<[^;{}()]*)?\{|\{|\})re");
  std::vector<std::string> scopes;  // "" where types are not counted
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
    if ((*it)[2].matched && counted && !scopes.empty()) found.push_back(path + it->str(2));
    scopes.push_back((*it)[1].matched ? it->str(1) : "");
  }
  return found;
}

TEST(House, FindsTypesOnlyWhereTheyAreDefinedForAll) {
  EXPECT_THAT(
      types_defined_in(
          "struct Outside {}; namespace a::b { // struct No {\n struct alignas(64) One : Base<int> { struct In {}; };"
          "template <class Row> void f(Row) { struct Local {}; } class Two; enum class Three { x };"
          "namespace { struct Four {}; } const char* text = \"struct Five {\"; class Six final {}; }"),
      testing::ElementsAre("a::b::One", "a::b::Three", "a::b::Six"));
}

// Two types of one name in one program are undefined behavior, whichever libraries they are in.
TEST(House, TypeNamesAreUnique) {
  std::map<std::string, std::string> places;
  for (const char* folder : {"kernels", "lib", "viewer", "apps"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".cpp" && extension != ".hpp") continue;
      for (const std::string& name : types_defined_in(text_of(entry.path()))) {
        const auto [place, added] = places.emplace(name, entry.path().string());
        EXPECT_TRUE(added) << name << " is defined in " << place->second << " and in " << entry.path();
      }
    }
  }
  EXPECT_GT(places.size(), 300U);
}

TEST(House, EveryFolderOfLibIsInTheTable) {
  for (const auto& entry : fs::directory_iterator(root / "lib")) {
    EXPECT_TRUE(!entry.is_directory() || house.count(entry.path().filename()) == 1) << entry.path();
  }
}

TEST(House, OnlyTheTrackerSeesTheOdometryClass) {
  for (const fs::path& file : sources_of(house.at("odometry"))) {
    if (file.stem() == "odometry") continue;
    for (const std::string& include : includes_of(text_of(file))) {
      EXPECT_NE(include, "odosplat/odometry/odometry.hpp") << file << ": modules do not know the whole";
    }
  }
}

// Text of files must not reach a terminal raw: these files escape it. A user's program in one file is no part of ours.
TEST(House, StandardStreamsAreWrittenInFewPlaces) {
  const Names places{"apps/output.cpp", "apps/support.cpp", "apps/example/track_images.cpp", "lib/core/progress.cpp"};
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
