// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/convention_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "odosplat/core/formatted.hpp"

namespace odosplat {
namespace {

std::string millimetres(double metres) {
  return std::isfinite(metres) ? formatted("%.1f mm", 1000.0 * metres) : "none";
}

std::string fy_text(const Convention& c, const Camera& camera) { return formatted("%+.1f", c.fy_sign * camera.fy); }
std::string poses_text(const Convention& c, const Camera& /*camera*/) { return c.inverted ? "inverted" : "as stored"; }
std::string shift_text(const Convention& c, const Camera& /*camera*/) {
  return c.id_shift == 0 ? "0" : formatted("%+d", c.id_shift);
}
std::string scale_text(const Convention& c, const Camera& /*camera*/) { return formatted("%g", c.depth_scale); }

struct Part {
  const char* name;
  std::string (*text)(const Convention&, const Camera&);
  bool (*same)(const Convention&, const Convention&);
};

const Part parts[] = {
    {"fy", fy_text, [](const Convention& a, const Convention& b) { return a.fy_sign == b.fy_sign; }},
    {"poses", poses_text, [](const Convention& a, const Convention& b) { return a.inverted == b.inverted; }},
    {"id shift", shift_text, [](const Convention& a, const Convention& b) { return a.id_shift == b.id_shift; }},
    {"depth scale", scale_text,
     [](const Convention& a, const Convention& b) { return a.depth_scale == b.depth_scale; }},
};

int agreement(const Convention& a, const Convention& b) {
  return static_cast<int>(
      std::count_if(std::begin(parts), std::end(parts), [&](const Part& p) { return p.same(a, b); }));
}

// The value of a part, with the other parts of the row that are not as declared: the row explains the images only with
// all of these values together.
std::string row_text(const Part& part, const ConventionRow& row, const Convention& declared, const Camera& camera) {
  std::string text = part.text(row.convention, camera);
  for (const Part& other : parts) {
    if (&other == &part || other.same(row.convention, declared)) continue;
    text += std::string(" with ") + other.name + " " + other.text(row.convention, camera);
  }
  return text + (row.tried ? formatted(" errs by %.3g %% of the depth", 100.0 * row.relative_error)
                           : std::string(" cannot be tried without more poses"));
}

// denied: no row that fits has the declared value, so the declared value is wrong although the right one is unknown.
std::string undecided_text(const Part& part, const ConventionRow& winner, const ConventionRow& other, bool denied,
                           const Convention& declared, const Camera& camera) {
  const std::string denial =
      denied ? "not " + part.text(declared, camera) + " as the file says; what it is instead " : "";
  return std::string(part.name) + ": " + denial + "not decidable from these images (" +
         row_text(part, winner, declared, camera) + ", " + row_text(part, other, declared, camera) + ")";
}

std::string difference_text(const Part& part, const Convention& winner, const Convention& declared,
                            const Camera& camera) {
  std::string text = std::string(part.name) + ": the data want " + part.text(winner, camera) + ", the file says " +
                     part.text(declared, camera);
  if (&part == &parts[3]) {
    text += " (depths are read " + formatted("%.4g", winner.depth_scale / declared.depth_scale) + " times too large)";
  }
  if (&part == &parts[0]) {
    text += " (or reflect the poses: F T F with F = diag(1, -1, 1))";
  } else if (winner.id_shift != declared.id_shift && &part == &parts[2]) {
    text += " (image k belongs to the pose of image k ";
    text += winner.id_shift > 0 ? "+ 1)" : "- 1)";
  }
  return text;
}

}  // namespace

void judge_conventions(ConventionReport& report, const Camera& camera, double max_error) {
  const ConventionRow& best = report.rows.front();
  const ConventionRow* winner = &best;
  for (const ConventionRow& row : report.rows) {
    if (agreement(row.convention, report.declared) > agreement(winner->convention, report.declared) &&
        std::isfinite(row.relative_error) && !beats(best, row)) {
      winner = &row;
    }
  }
  report.winner = winner->convention;
  report.winner_error_m = winner->error_m;
  report.believable = winner->relative_error <= max_error;

  std::string differences;
  std::string open;
  for (const Part& part : parts) {
    ConventionFinding finding;
    finding.part = part.name;
    finding.as_declared = part.same(report.winner, report.declared);
    const auto fits_otherwise = [&](const ConventionRow& row) {
      return !part.same(row.convention, report.winner) &&
             agreement(row.convention, report.winner) >= static_cast<int>(std::size(parts)) - 2 && !beats(*winner, row);
    };
    auto other = std::find_if(report.rows.begin(), report.rows.end(), fits_otherwise);
    // A row with the declared value of this part, and another value of one other part, may fit as well as the winner.
    const auto declared = std::find_if(report.rows.begin(), report.rows.end(), [&](const ConventionRow& row) {
      return fits_otherwise(row) && part.same(row.convention, report.declared);
    });
    if (!finding.as_declared && declared != report.rows.end()) other = declared;
    finding.decided = other == report.rows.end();
    if (!finding.decided) {
      const bool denied = !finding.as_declared && declared == report.rows.end();
      finding.text = undecided_text(part, *winner, *other, denied, report.declared, camera);
      open += "; " + finding.text;
    } else if (!finding.as_declared) {
      finding.text = difference_text(part, report.winner, report.declared, camera);
      differences += (differences.empty() ? "" : "; ") + finding.text;
    }
    report.findings.push_back(finding);
  }
  report.as_declared = report.believable && report.winner == report.declared;
  if (!report.believable) {
    report.verdict = "no convention fits: the best errs by " + millimetres(winner->error_m) + ", " +
                     formatted("%.1f %% of the depth (%.0f %% of the pixels overlap at a gap of %d frames)",
                               100.0 * winner->relative_error, 100.0 * winner->overlap, report.gap);
  } else if (report.as_declared) {
    report.verdict = "the data agree with what is declared, to " + millimetres(winner->error_m) + open;
  } else {
    // Several parts can explain the difference, so none is decided, but the declared convention does not hold.
    report.verdict =
        differences.empty() ? "the data do not agree with what is declared; " + open.substr(2) : differences + open;
  }
}

std::string convention_text(const Convention& convention, const Camera& camera) {
  return "fy " + fy_text(convention, camera) + ", poses " + poses_text(convention, camera) + ", id shift " +
         shift_text(convention, camera) + ", depth scale " + scale_text(convention, camera);
}

std::string convention_table(const ConventionReport& report, const Camera& camera, std::size_t max_rows) {
  std::string table = "         fy  poses      id shift  depth scale   error mm   error %  overlap %\n";
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    const ConventionRow& row = report.rows[i];
    const bool is_declared = row.convention == report.declared;
    const bool is_winner = row.convention == report.winner;
    if (i >= max_rows && !is_declared && !is_winner) continue;
    const bool measured = std::isfinite(row.relative_error);
    table += formatted("%c%c %8s  %-9s  %8s  %11s  %9s  %8s  %9.1f\n", is_winner ? '*' : ' ', is_declared ? 'd' : ' ',
                       fy_text(row.convention, camera).c_str(), poses_text(row.convention, camera).c_str(),
                       shift_text(row.convention, camera).c_str(), scale_text(row.convention, camera).c_str(),
                       measured ? formatted("%.2f", 1000.0 * row.error_m).c_str() : "-",
                       measured ? formatted("%.3f", 100.0 * row.relative_error).c_str() : "-", 100.0 * row.overlap);
  }
  return table;
}

}  // namespace odosplat
