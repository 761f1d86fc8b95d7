// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// The page of `odosplat view web` as a file; tests/viewer/web shows it in browsers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/cli/view/web/web_page.hpp"
#include "apps/command/html_text.hpp"
#include "odosplat/core/base64.hpp"
#include "odosplat/splat/map_file.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps {
namespace {

using apps_test::read_text;
using apps_test::run_odosplat;
using apps_test::RunResult;
using apps_test::ScratchFolder;
using apps_test::write_text;
using apps_test::write_tiny_sequence;
using testing::HasSubstr;
using testing::Not;

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

void write_small_map(const std::string& path, std::size_t count, int degree = 0) {
  Map map;
  map.gaussians.sh_degree = degree;
  map.gaussians.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      map.gaussians.positions[3 * i + c] = 3.0F * std::sin(static_cast<float>((c + 1) * i));
      map.gaussians.log_scales[3 * i + c] = -3.0F;
    }
    map.gaussians.rotations[4 * i] = 1.0F;
  }
  map.header = MapHeader::from_notes({blend_order_line(BlendOrder::distance)});
  write_map(path, map);
}

/// The JSON of a page.
nlohmann::json data_of(const std::string& html) {
  const std::string opening = "<script type=\"application/json\" id=\"data\">";
  const std::size_t at = html.find(opening) + opening.size();
  return nlohmann::json::parse(html.substr(at, html.find("</script>", at) - at));
}

TEST(HtmlText, IsEscaped) {
  EXPECT_EQ(html_escaped("a<b> & \"c\" 'd'"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
  const std::string json = json_for_html(R"({"a": "</script><b>&<!--"})");
  EXPECT_THAT(json, Not(testing::ContainsRegex("[<>&]")));
  EXPECT_EQ(nlohmann::json::parse(json).at("a"), "</script><b>&<!--");
}

TEST(HtmlText, Base64IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\xfb\x00", 3)), "//sA");
}

TEST(WebPage, NoNameBreaksIt) {
  WebPage plain{"map", {{"title", "map"}, {"runs", {{{"name", "run"}}}}}, "", ""};
  const std::string evil = "</script><b>{{map}}<!--\" onload='x'";
  WebPage page{evil, {{"title", evil}, {"runs", {{{"name", evil}}}}}, "", ""};
  const std::string html = html_of(page);
  for (const char* word : {"<script", "</script", "<b>", "<!--"}) {
    EXPECT_EQ(count_of(html, word), count_of(html_of(plain), word)) << word;
  }
  EXPECT_EQ(data_of(html).at("runs")[0].at("name"), evil);
  EXPECT_THAT(html, HasSubstr("<title>&lt;/script&gt;&lt;b&gt;"));
}

TEST(WebPage, AsksForNothingOutside) {
  const std::string html = html_of({"map", {{"title", "map"}}, "", ""});
  EXPECT_THAT(html, HasSubstr("http-equiv=\"Content-Security-Policy\" content=\"default-src 'none';"));
  for (const char* word : {"http:", "https:", "//cdn", "@import", "fetch(", "XMLHttpRequest", " src=", "url("}) {
    EXPECT_EQ(count_of(html, word), 0U) << word;
  }
  EXPECT_EQ(count_of(html, "href="), 1U) << "the icon, which is empty";
  for (const auto& [name, text] : page_texts()) {
    EXPECT_EQ(count_of(std::string(text), "</script>"), name == "page.html" ? 5U : 0U) << name;
    if (name == "page.html") continue;
    EXPECT_THAT(html, HasSubstr(std::string(text))) << name << " is not in the page";
    EXPECT_EQ(text.find("SPDX-License-Identifier: Apache-2.0"), 3U) << name;
  }
}

class ViewWeb : public testing::Test {
 protected:
  void SetUp() override {
    write_small_map(map_, 60, 1);
    write_tiny_sequence(sequence_, 24);
  }
  RunResult view(const std::vector<std::string>& more) {
    std::vector<std::string> words{"view", "web", "--map", map_, "--out", page_, "--log", "warning"};
    words.insert(words.end(), more.begin(), more.end());
    return run_odosplat(words);
  }

  ScratchFolder folder_;
  std::string map_ = folder_ / "<!--<b>.ply";
  std::string page_ = folder_ / "page.html";
  std::string sequence_ = folder_ / "seq";
};

TEST_F(ViewWeb, HoldsMapPathsErrorsAndImages) {
  std::filesystem::create_directory(folder_ / "run");
  std::filesystem::copy_file(folder_ / "seq/groundtruth.txt", folder_ / "run/trajectory.txt");
  const RunResult done = view({"--poses", folder_ / "run", "--truth", sequence_, "--sequence", sequence_, "--images",
                               "5", "--title", "</script><b>"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("60 Gaussians, SH degree 1"));
  EXPECT_THAT(done.out, HasSubstr("with 5 images"));
  const std::string html = read_text(page_);
  EXPECT_EQ(count_of(html, "</script>"), 5U) << "as many as page.html has, whatever the title is";
  const nlohmann::json data = data_of(html);
  EXPECT_EQ(data.at("map").at("order"), "distance");
  EXPECT_EQ(data.at("map").at("name"), "<!--<b>.ply");
  EXPECT_EQ(data.at("title"), "</script><b>");
  EXPECT_EQ(data.at("times").at("count"), 24);
  ASSERT_EQ(data.at("images").size(), 5U);
  EXPECT_EQ(data.at("images")[0].at("frame"), 0);
  EXPECT_EQ(data.at("images")[4].at("frame"), 23);
  EXPECT_EQ(data.at("images")[4].at("name"), "0023.png");
  ASSERT_EQ(data.at("runs").size(), 1U);
  EXPECT_EQ(data.at("runs")[0].at("name"), "run");
  EXPECT_NEAR(data.at("runs")[0].at("ate_m").at("max").get<double>(), 0.0, 1e-9);
  EXPECT_EQ(data.at("camera").at("width"), 160);
  EXPECT_EQ(data.at("alignment"), "none");
}

TEST_F(ViewWeb, AMapAloneIsEnough) {
  const RunResult done = view({"--sh-degree", "0"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("SH degree 0 (reduced from 1)"));
  const nlohmann::json data = data_of(read_text(page_));
  EXPECT_TRUE(data.at("camera").is_null());
  EXPECT_TRUE(data.at("truth").is_null());
  EXPECT_TRUE(data.at("images").empty());
  EXPECT_EQ(data.at("map").at("degree"), 0);
  EXPECT_EQ(data.at("map").at("map_degree"), 1);
}

TEST_F(ViewWeb, ImagesAreLeftOutWithZero) {
  ASSERT_EQ(view({"--sequence", sequence_, "--images", "0"}).status, 0);
  const nlohmann::json data = data_of(read_text(page_));
  EXPECT_TRUE(data.at("images").empty());
  EXPECT_EQ(data.at("camera").at("width"), 160);
  EXPECT_EQ(data.at("times").at("count"), 24);
}

TEST_F(ViewWeb, LargeMapsAreThinnedOnlyOnRequest) {
  write_small_map(map_, 300001);
  const RunResult refused = view({});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("has 300001 Gaussians, a page takes 300000: --budget N keeps the N most visible"));
  EXPECT_FALSE(std::filesystem::exists(page_));
  const RunResult done = view({"--budget", "1000"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("1000 Gaussians, SH degree 0, of 300001: "));
  EXPECT_TRUE(data_of(read_text(page_)).at("map").at("thinned").get<bool>());
}

TEST_F(ViewWeb, SaysWhatIsWrong) {
  const auto fault = [&](const std::vector<std::string>& more) {
    const RunResult result = view(more);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(std::filesystem::exists(page_));
    return result.err;
  };
  EXPECT_THAT(fault({"--frames", "0:5"}), HasSubstr("--frames: needs --sequence or --truth"));
  EXPECT_THAT(fault({"--layout", "tum"}), HasSubstr("--layout: needs --sequence or --truth"));
  EXPECT_THAT(fault({"--align", "se3"}), HasSubstr("--align: needs --truth"));
  EXPECT_THAT(fault({"--images", "3"}), HasSubstr("--sequence"));
  EXPECT_THAT(fault({"--times", "t.txt"}), HasSubstr("--times: needs --poses"));
  EXPECT_THAT(fault({"--sequence", sequence_, "--frames", "30:40"}), HasSubstr("the sequence has 24"));
  EXPECT_THAT(fault({"--poses", folder_ / "none"}), HasSubstr("none"));
  EXPECT_THAT(fault({"--poses", folder_ / "seq/groundtruth.txt", "--truth", sequence_, "--align", "best"}),
              HasSubstr("align"));
  std::filesystem::create_directory(folder_ / "run");
  write_text(folder_ / "run/trajectory.txt", read_text(folder_ / "seq/groundtruth.txt"));
  write_text(folder_ / "run/status.csv", "time,status,in_map\n0,fine,1\n");
  EXPECT_THAT(fault({"--poses", folder_ / "run"}), HasSubstr("status.csv: line 2: status must be"));
  write_text(folder_ / "far.txt", "5000 0 0 0 0 0 0 1\n5001 0 0 0 0 0 0 1\n");
  EXPECT_THAT(fault({"--poses", folder_ / "far.txt", "--sequence", sequence_}), HasSubstr("no image has the time"));
  const RunResult named = run_odosplat({"view", "web", "--map", map_, "--out", folder_ / "page.png"});
  EXPECT_EQ(named.status, 2);
  EXPECT_THAT(named.err, HasSubstr(".html"));
}

}  // namespace
}  // namespace odosplat::apps
