// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// The reports of invented benchmark results: two sequences, three methods, two runs, one crash, one tie.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/benchmark/report/report.hpp"
#include "apps/benchmark/report/report_formats.hpp"
#include "apps/benchmark/report/results.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "tests/apps/run_program.hpp"

namespace odosplat::apps {
namespace {

using apps_test::read_text;
using apps_test::ScratchFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

RunFacts run_of(const std::string& sequence, const std::string& method, int run, double ate_m) {
  RunFacts facts;
  facts.sequence = sequence;
  facts.method = method;
  facts.run = run;
  facts.seed = static_cast<std::uint64_t>(run);
  facts.frames = 100;
  facts.posed = 100;
  facts.unaligned.ate_m.rmse = ate_m;
  facts.unaligned.ate_m.max = 3.0 * ate_m;
  facts.unaligned.rte_m.rmse = 0.1 * ate_m;
  facts.unaligned.rre_deg.rmse = ate_m;
  facts.unaligned.coverage = 1.0;
  facts.aligned.ate_m.rmse = 0.5 * ate_m;
  facts.live_ate_m = 1.5 * ate_m;
  facts.ms_per_frame = 10.0 + run;
  facts.p95_ms = 20.0 + run;
  facts.cpu_ms = 15.0;
  facts.peak_memory_mb = 300.0;
  return facts;
}

SequenceFacts sequence_of(const std::string& name) {
  SequenceFacts facts;
  facts.name = name;
  facts.scene = "living_room";
  facts.words = "Living room";
  facts.frames = 100;
  facts.seconds = 3.3;
  facts.length_m = 2.05;
  facts.width = 320;
  facts.height = 240;
  facts.checksum = "00ff";
  facts.convention = "ok";
  facts.texture = 0.234;
  return facts;
}

/// Two runs each. On icl_2 gaussian and paper both print as 0.0021; on a<b paper crashes.
BenchmarkResults two_sequences() {
  BenchmarkResults results;
  results.suite = "made up";
  results.methods = {"gaussian", "paper", "interpolation"};
  results.runs = 2;
  results.sequences = {sequence_of("icl_2"), sequence_of("a<b>&_c")};
  results.maps.push_back({"living_room", "default", 1000, 400, 61.0, 33.5, 250.0, ""});
  for (int run = 1; run <= 2; ++run) {
    results.cells.push_back(run_of("icl_2", "gaussian", run, run == 1 ? 0.00205 : 0.00217));
    results.cells.push_back(run_of("icl_2", "paper", run, 0.00213));
    results.cells.push_back(run_of("icl_2", "interpolation", run, 0.012));
    results.cells.push_back(run_of("a<b>&_c", "gaussian", run, 0.003));
    RunFacts crash;
    crash.sequence = "a<b>&_c";
    crash.method = "paper";
    crash.run = run;
    crash.fault = "killed by signal 11 (Segmentation fault)";
    results.cells.push_back(crash);
    results.cells.push_back(run_of("a<b>&_c", "interpolation", run, 0.004));
  }
  results.machine = "a processor, 2 cores";
  results.device = "pocl";
  results.version = "0.1.0";
  results.command = "odosplat benchmark --suite x";
  results.mapping = "every 10th frame";
  return results;
}

ReportFigure picture_in(const ScratchFolder& folder) {
  write_rgb8(folder / "figures/one.png", cv::Mat3b(2, 2, cv::Vec3b(1, 2, 3)));
  return {"figures/one.png", "A figure", "Its caption.", ""};
}

std::string written(const BenchmarkResults& results, const std::string& file) {
  const ScratchFolder folder;
  write_reports(results, {picture_in(folder), {"", "Another figure", "", "no map"}}, folder.path());
  return read_text(folder / file);
}

const std::vector<std::string> texts{"report.md", "report.html", "report.json", "tables.csv", "tables.tex"};

TEST(Places, AreOfTheValuesAsPrinted) {
  EXPECT_THAT(places({0.3, 0.1, 0.2}, 3), ElementsAre(0, 1, 2));
  EXPECT_THAT(places({0.10004, 0.10001, 0.2}, 4), ElementsAre(1, 1, 0));
  EXPECT_THAT(places({0.1, 0.20004, 0.20001, 0.3}, 4), ElementsAre(1, 2, 2, 0));
  EXPECT_THAT(places({std::nullopt, 0.2, std::nullopt}, 4), ElementsAre(0, 1, 0));
  EXPECT_TRUE(places({}, 4).empty());
}

TEST(Summary, IsTheMedianOfTheRunsThatWentThrough) {
  BenchmarkResults results = two_sequences();
  const auto summary = summarise(results, "icl_2", "gaussian");
  ASSERT_TRUE(summary);
  EXPECT_TRUE(summary->complete());
  EXPECT_DOUBLE_EQ(summary->ate_m.median, 0.00211);
  EXPECT_DOUBLE_EQ(summary->ate_m.low, 0.00205);
  EXPECT_DOUBLE_EQ(summary->ate_m.high, 0.00217);
  EXPECT_DOUBLE_EQ(summary->ms_per_frame.median, 11.5);
  const auto crashed = summarise(results, "a<b>&_c", "paper");
  ASSERT_TRUE(crashed);
  EXPECT_EQ(crashed->runs, 0);
  EXPECT_EQ(crashed->failed, 2);
  EXPECT_EQ(crashed->fault, "killed by signal 11 (Segmentation fault)");
  EXPECT_FALSE(summarise(results, "icl_2", "surfel"));
  results.cells[0].fault = "over 60 s";
  EXPECT_FALSE(summarise(results, "icl_2", "gaussian")->complete());
  EXPECT_DOUBLE_EQ(summarise(results, "icl_2", "gaussian")->ate_m.median, 0.00217);
}

TEST(PaperRows, AreComplete) {
  ASSERT_EQ(paper_rows().size(), 40U);
  int crashed = 0;
  for (const PaperRow& row : paper_rows()) crashed += row.ate_m < 0.0 ? 1 : 0;
  EXPECT_EQ(crashed, 2);
}

TEST(Reports, MarkdownRows) {
  const std::string text = written(two_sequences(), "report.md");
  EXPECT_THAT(text, HasSubstr("| icl_2 | **0.0021**<br><small>0.0021..0.0022</small> | "
                              "**0.0021**<br><small>0.0021..0.0021</small> | "
                              "0.0120<br><small>0.0120..0.0120</small> |"));
  EXPECT_THAT(text, HasSubstr("| a&lt;b&gt;&amp;\\_c | **0.0030**<br><small>0.0030..0.0030</small> | x<sup>1</sup> | "
                              "<u>0.0040</u><br><small>0.0040..0.0040</small> |"));
  EXPECT_THAT(text, HasSubstr("<sup>1</sup> killed by signal 11 (Segmentation fault)\n"));
  EXPECT_THAT(text, HasSubstr("| icl_2 | Living room | 100 | 3.3 | 2.05 | 320x240 | 23.4 | 00ff | ok |\n"));
  EXPECT_THAT(text, HasSubstr("![A figure](figures/one.png)"));
  EXPECT_THAT(text, HasSubstr("Left out: no map"));
  EXPECT_LT(text.find("## Figures"), text.find("## Speed"));
}

TEST(Reports, CsvRows) {
  const std::string text = written(two_sequences(), "tables.csv");
  EXPECT_THAT(text, HasSubstr("table,row,method,quantity,value,low,high,printed,mark,note,label\n"));
  EXPECT_THAT(text, HasSubstr("\naccuracy,icl_2,gaussian,ate_m,0.00211,0.00205,0.00217,0.0021,best,,\n"));
  EXPECT_THAT(text, HasSubstr("\naccuracy,icl_2,paper,ate_m,0.00213,0.00213,0.00213,0.0021,best,,\n"));
  EXPECT_THAT(text, HasSubstr("\naccuracy,icl_2,interpolation,ate_m,0.012,0.012,0.012,0.0120,,,\n"));
  EXPECT_THAT(text, HasSubstr("\naccuracy,a<b>&_c,paper,ate_m,,,,x,,killed by signal 11 (Segmentation fault),\n"));
  EXPECT_THAT(text, HasSubstr("\naccuracy,a<b>&_c,interpolation,ate_m,0.004,0.004,0.004,0.0040,second,,\n"));
  EXPECT_THAT(text, HasSubstr("\nsequences,icl_2,,scene,Living room,,,Living room,,,\n"));
  EXPECT_THAT(text, HasSubstr("\npaper,augm_3,DSL,ate_m,,,,x,,\"crashed, says the paper\",as published\n"));
  EXPECT_THAT(text, HasSubstr("\npaper,icl_1,MonoGS,rre_deg,1.258,,,1.258,,,as published\n"));
}

TEST(Reports, TexRows) {
  const std::string text = written(two_sequences(), "tables.tex");
  EXPECT_THAT(text, HasSubstr("icl\\_2 & \\shortstack{\\textbf{0.0021}\\\\{\\tiny 0.0021..0.0022}} & "
                              "\\shortstack{\\textbf{0.0021}\\\\{\\tiny 0.0021..0.0021}} &"));
  EXPECT_THAT(text, HasSubstr("a\\textless{}b\\textgreater{}\\&\\_c & "
                              "\\shortstack{\\textbf{0.0030}\\\\{\\tiny 0.0030..0.0030}} & $\\times$$^{1}$ & "
                              "\\shortstack{\\uline{0.0040}\\\\{\\tiny 0.0040..0.0040}}"));
  // With spreads of several runs the three groups are separate tables, otherwise they are side by side.
  EXPECT_THAT(text, HasSubstr("\\caption{Accuracy of localisation (the paper's Table 2): RMSE of RTE (m)."));
  EXPECT_THAT(text, HasSubstr("Sequence & gaussian & paper & interpolation \\\\\n"));
  BenchmarkResults one_run = two_sequences();
  std::erase_if(one_run.cells, [](const RunFacts& run) { return run.run == 2; });
  const std::string wide = written(one_run, "tables.tex");
  EXPECT_THAT(wide, HasSubstr("& \\multicolumn{3}{c}{RMSE of ATE (m)} & \\multicolumn{3}{c}{RMSE of RTE (m)}"));
  EXPECT_THAT(wide, HasSubstr("\\cmidrule(lr){2-4}\\cmidrule(lr){5-7}\\cmidrule(lr){8-10}"));
}

TEST(Reports, TheAblationComparesWithGaussian) {
  const std::string with = written(two_sequences(), "tables.csv");
  EXPECT_THAT(with, HasSubstr("\nablation,icl_2,interpolation,ate_m,0.012,0.012,0.012,0.0120,,,\n"));
  EXPECT_THAT(with, HasSubstr("\nablation,icl_2,gaussian,ate_m,0.00211,0.00205,0.00217,0.0021,best,,\n"));
  EXPECT_THAT(with, Not(HasSubstr("\nablation,icl_2,paper")));
  BenchmarkResults results = two_sequences();
  results.methods = {"gaussian", "paper"};
  EXPECT_THAT(written(results, "tables.csv"), Not(HasSubstr("\nablation,")));
}

TEST(Reports, WhatCannotBeComparedIsNotRanked) {
  BenchmarkResults results = two_sequences();
  results.cells[0].unaligned.coverage = 0.4567;  // gaussian on icl_2, first run
  const std::string half_lost = written(results, "tables.csv");
  EXPECT_THAT(half_lost, HasSubstr("\naccuracy,icl_2,gaussian,ate_m,0.00211,0.00205,0.00217,0.0021,,"
                                   "\"posed 45.6 % of the frames, not ranked\",\n"));
  EXPECT_THAT(half_lost, HasSubstr("\naccuracy,icl_2,interpolation,ate_m,0.012,0.012,0.012,0.0120,second,,\n"));
  results = two_sequences();
  results.cells[0].fault = "over 60 s";
  EXPECT_THAT(written(results, "tables.csv"),
              HasSubstr("\naccuracy,icl_2,gaussian,ate_m,0.00217,,,0.0022,,"
                        "\"1 of 2 runs went through, not ranked; another: over 60 s\",\n"));
}

TEST(Reports, OneMethodAloneIsNotTheBest) {
  BenchmarkResults results = two_sequences();
  results.methods = {"gaussian"};
  const std::string text = written(results, "tables.csv");
  EXPECT_THAT(text, HasSubstr("\naccuracy,icl_2,gaussian,ate_m,0.00211"));
  EXPECT_THAT(text, Not(HasSubstr(",best,")));
}

TEST(Reports, TablesDoNotKnowHowFastTheMachineWas) {
  BenchmarkResults slow = two_sequences();
  for (RunFacts& run : slow.cells) {
    run.ms_per_frame *= 7.0;
    run.p95_ms *= 7.0;
    run.cpu_ms *= 7.0;
    run.peak_memory_mb *= 7.0;
  }
  slow.maps[0].seconds *= 7.0;
  slow.maps[0].peak_memory_mb *= 7.0;
  for (const char* file : {"tables.csv", "tables.tex"}) {
    EXPECT_EQ(written(two_sequences(), file), written(slow, file)) << file;
  }
  EXPECT_THAT(written(slow, "speed.csv"), HasSubstr("\nspeed,icl_2,gaussian,ms_per_frame,80.5,77,84,80.5,,,\n"));
  EXPECT_THAT(written(slow, "speed.csv"), HasSubstr("\ntraining,living_room,default,seconds,427,,,427,,,\n"));
  auto quick_json = nlohmann::json::parse(written(two_sequences(), "report.json"));
  auto slow_json = nlohmann::json::parse(written(slow, "report.json"));
  EXPECT_NE(quick_json, slow_json);
  quick_json.erase("speed");
  slow_json.erase("speed");
  EXPECT_EQ(quick_json, slow_json);
}

TEST(Reports, StandInsAreLabelledAtEveryTable) {
  for (const std::string& file : texts) {
    EXPECT_THAT(written(two_sequences(), file), Not(HasSubstr("stand-in"))) << file;
  }
  BenchmarkResults results = two_sequences();
  results.stand_in = true;
  const ReportTables tables = make_report_tables(results);
  for (const auto& group : {tables.accuracy, tables.speed}) {
    for (const ReportTable& table : group) {
      EXPECT_EQ(table.label, table.key == "paper" ? "as published" : "stand-in");
      EXPECT_THAT(written(results, "report.md"), HasSubstr(table.title + " (" + table.label + ")"));
      EXPECT_THAT(written(results, "report.html"), HasSubstr(" <span class=\"label\">" + table.label + "</span></h3>"));
    }
  }
  EXPECT_THAT(written(results, "tables.tex"),
              HasSubstr("\\caption{Accuracy of localisation (the paper's Table 2): RMSE "
                        "of ATE (m) (stand-in)."));
  EXPECT_THAT(written(results, "tables.tex"), HasSubstr("not to be ranked against the stand-ins"));
  EXPECT_THAT(written(results, "tables.csv"), HasSubstr(",0.0021,best,,stand-in\n"));
  EXPECT_EQ(nlohmann::json::parse(written(results, "report.json"))["tables"]["accuracy"]["label"], "stand-in");
}

TEST(Reports, JsonHoldsTablesAndRuns) {
  BenchmarkResults results = two_sequences();
  results.command = "not UTF-8: \xff";
  const auto json = nlohmann::json::parse(written(results, "report.json"));
  EXPECT_EQ(json["runs"].size(), 12U);
  EXPECT_DOUBLE_EQ(json["runs"][0]["ate_m"]["rmse"], 0.00205);
  EXPECT_EQ(json["runs"][4]["fault"], "killed by signal 11 (Segmentation fault)");
  EXPECT_FALSE(json["runs"][4].contains("ate_m"));
  EXPECT_EQ(json["speed"]["runs"].size(), 10U);
  EXPECT_EQ(json["tables"]["accuracy"]["cells"].size(), 18U);
  EXPECT_EQ(json["tables"]["accuracy"]["cells"][0]["mark"], "best");
}

TEST(Reports, HtmlStandsAloneAndEscapes) {
  const std::string text = written(two_sequences(), "report.html");
  EXPECT_THAT(text, HasSubstr("<th class=\"name\">a&lt;b&gt;&amp;_c</th>"));
  EXPECT_THAT(text, Not(HasSubstr("a<b>")));
  EXPECT_THAT(text, HasSubstr("<td class=\"first\"><b>0.0021</b><small>0.0021..<wbr>0.0022</small></td>"));
  EXPECT_THAT(text, HasSubstr("<td>x<sup>1</sup></td>"));
  // The base64 text of the first bytes of a PNG.
  EXPECT_THAT(text, HasSubstr("src=\"data:image/png;base64,iVBORw0K"));
  for (const char* outside : {"http", "url(", "<script", "<link", "@import", "href"}) {
    EXPECT_THAT(text, Not(HasSubstr(outside)));
  }
}

TEST(Reports, IncompleteResultsAreReported) {
  BenchmarkResults results = two_sequences();
  results.cells.clear();
  results.maps.clear();
  results.sequences[1].fault = "no such folder";
  EXPECT_THAT(written(results, "report.md"), HasSubstr("| icl_2 | - | - | - |"));
  EXPECT_THAT(written(results, "tables.csv"), HasSubstr("\nsequences,a<b>&_c,,frames,,,,x,,no such folder,\n"));
  BenchmarkResults nothing;
  for (const std::string& file : texts) EXPECT_FALSE(written(nothing, file).empty()) << file;
}

TEST(Reports, AMissingFigureFileIsNamed) {
  const ScratchFolder folder;
  EXPECT_THROW(write_reports(two_sequences(), {{"figures/none.png", "A figure", "", ""}}, folder.path()), InputError);
}

}  // namespace
}  // namespace odosplat::apps
