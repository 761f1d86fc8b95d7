// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/check/cloud_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "odosplat/cloud/length_units.hpp"
#include "odosplat/core/angles.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat {
namespace {

struct Part {
  const char* name;
  std::string (*text)(const CloudReading&, const Camera&);
  bool (*same)(const CloudReading&, const CloudReading&);
};

const Part parts[] = {
    {"fy", [](const CloudReading& r, const Camera& camera) { return formatted("%+.1f", r.fy_sign * camera.fy); },
     [](const CloudReading& a, const CloudReading& b) { return a.fy_sign == b.fy_sign; }},
    {"cloud's y",
     [](const CloudReading& r, const Camera& /*camera*/) { return std::string(r.mirrored ? "negated" : "as stored"); },
     [](const CloudReading& a, const CloudReading& b) { return a.mirrored == b.mirrored; }},
    {"poses",
     [](const CloudReading& r, const Camera& /*camera*/) { return std::string(r.inverted ? "inverted" : "as stored"); },
     [](const CloudReading& a, const CloudReading& b) { return a.inverted == b.inverted; }},
    {"id shift",
     [](const CloudReading& r, const Camera& /*camera*/) {
       return r.id_shift == 0 ? std::string("0") : formatted("%+d", r.id_shift);
     },
     [](const CloudReading& a, const CloudReading& b) { return a.id_shift == b.id_shift; }},
};

int agreement(const CloudReading& a, const CloudReading& b) {
  return static_cast<int>(
      std::count_if(std::begin(parts), std::end(parts), [&](const Part& p) { return p.same(a, b); }));
}

const CloudRow& row_of(const CloudCheckReport& report, const CloudReading& reading) {
  return *std::find_if(report.rows.begin(), report.rows.end(),
                       [&](const CloudRow& row) { return row.reading == reading; });
}

std::string difference_text(const Part& part, const CloudReading& winner, const CloudReading& declared,
                            const Camera& camera) {
  std::string text = std::string(part.name) + ": the images want " + part.text(winner, camera) + ", the files say " +
                     part.text(declared, camera);
  if (&part == &parts[3]) {
    text += formatted(" (image k belongs to the pose of image k %c %d)", winner.id_shift > 0 ? '+' : '-',
                      std::abs(winner.id_shift));
  }
  return text;
}

CloudFinding part_finding(const CloudCheckReport& report, const Part& part, const Camera& camera) {
  CloudFinding finding;
  finding.part = part.name;
  const CloudRow& winner = row_of(report, report.winner);
  const auto rival = std::find_if(report.rows.begin(), report.rows.end(), [&](const CloudRow& row) {
    return !part.same(row.reading, report.winner) &&
           agreement(row.reading, report.winner) >= static_cast<int>(std::size(parts)) - 2 && !beats(winner, row);
  });
  if (rival != report.rows.end()) {
    const auto says = [&](const CloudRow& row) {
      return part.text(row.reading, camera) +
             (row.tried ? formatted(" differs by %.2f", row.relative_error) : " cannot be tried without more poses");
    };
    finding.text =
        std::string(part.name) + ": not decidable from these images (" + says(winner) + ", " + says(*rival) + ")";
    return finding;
  }
  finding.right = part.same(report.winner, report.declared);
  if (!*finding.right) finding.text = difference_text(part, report.winner, report.declared, camera);
  return finding;
}

// The finding for a measured deviation: wrong if it is large and significant, undecided if its sigma is too large.
CloudFinding fit_finding(const char* part, double departure, double sigma, double least, double sure,
                         const std::string& wrong, const std::string& open) {
  CloudFinding finding;
  finding.part = part;
  if (departure > least && departure > sure * sigma) {
    finding.right = false;
    finding.text = std::string(part) + ": " + wrong;
  } else if (sure * sigma > 3.0 * least) {
    finding.text = std::string(part) + ": not decidable from these images (" + open + ")";
  } else {
    finding.right = true;
  }
  return finding;
}

std::vector<CloudFinding> fit_findings(const CloudFit& fit, const CloudCheckOptions& o, const Camera& camera) {
  std::vector<CloudFinding> findings;
  const double scale = 1.0 / fit.scale.value;
  const double scale_sigma = fit.scale.sigma * scale * scale;
  findings.push_back(
      fit_finding("cloud scale", std::abs(scale - 1.0), scale_sigma, o.least_scale, o.sure,
                  formatted("the cloud is %.4g times as large as the poses say, +- %.2g", scale, scale_sigma),
                  formatted("%.3g +- %.2g", scale, scale_sigma)));
  // If only the scale about the world's origin is wrong, the visible part is shifted but the origin is not. With a
  // wrong scale the offset is therefore taken at the origin.
  const bool scaled = findings.back().right == false;
  const Measured& offset = scaled ? fit.origin_offset_m : fit.offset_m;
  findings.push_back(fit_finding(
      "cloud offset", offset.value, offset.sigma, o.least_offset * fit.median_depth_m, o.sure,
      formatted("the cloud is off by %.3f m +- %.3f (to be moved by %.3f %.3f %.3f%s)", offset.value, offset.sigma,
                fit.offset.x(), fit.offset.y(), fit.offset.z(), scaled ? " in its middle" : ""),
      formatted("%.2f +- %.2g m", offset.value, offset.sigma)));
  findings.push_back(fit_finding(
      "cloud rotation", fit.turn_deg.value, fit.turn_deg.sigma, degrees_per_radian * o.least_offset, o.sure,
      formatted("the cloud is turned by %.2f deg +- %.2f against the poses", fit.turn_deg.value, fit.turn_deg.sigma),
      formatted("%.2f +- %.2g deg", fit.turn_deg.value, fit.turn_deg.sigma)));
  findings.push_back(fit_finding("focal length", std::abs(fit.focal_px.value / camera.fx - 1.0),
                                 fit.focal_px.sigma / camera.fx, o.least_focal, o.sure,
                                 formatted("the images want fx = %.1f +- %.1f px, the camera file says %.1f",
                                           fit.focal_px.value, fit.focal_px.sigma, camera.fx),
                                 formatted("%.1f +- %.2g px", fit.focal_px.value, fit.focal_px.sigma)));
  return findings;
}

}  // namespace

void choose_reading(CloudCheckReport& report, double max_error) {
  const CloudRow& best = report.rows.front();
  const CloudRow* winner = &best;
  for (const CloudRow& row : report.rows) {
    if (agreement(row.reading, report.declared) > agreement(winner->reading, report.declared) &&
        std::isfinite(row.relative_error) && !beats(best, row)) {
      winner = &row;
    }
  }
  report.winner = winner->reading;
  report.believable = winner->relative_error <= max_error;
}

namespace {

// The errors with the cloud and with both controls, as part of a sentence.
std::string control_text(const CloudControl& control) {
  const auto text = [](const PairScores& scores) {
    return std::isfinite(scores.relative_error) ? formatted("%.2f", scores.relative_error) : std::string("-");
  };
  return "patches differ by " + text(control.cloud) + " with it, by " + text(control.flat) +
         " with a flat wall at its distance, by " + text(control.distant) + " with one far off";
}

std::string doubt_text(const CloudCheckReport& report, const CloudCheckOptions& options) {
  // If patches agree over the largest gap even with the distant control, the camera hardly moved relative to the scene.
  const CloudControl& given = report.given;
  const bool controls_lose = beats(given.cloud, given.flat) && beats(given.cloud, given.distant);
  const bool still = report.largest_gap_error <= options.max_error &&
                     given.distant.relative_error <= options.max_error && !controls_lose;
  const std::string controls = " (" + control_text(report.given) + ")";
  if (still) {
    return "the images do not tell whether the cloud fits: the camera hardly moves against the cloud's distances" +
           controls;
  }
  return "the cloud does not fit these images" + controls +
         "; cause not decidable: a cloud of another place, turned, in another unit or far off, poses or a camera that "
         "are wrong, or images of one flat wall";
}

// Changes a finding of an error to "not decidable", for errors whose correction does not improve the agreement.
void withdraw(CloudFinding& finding, const std::string& why) {
  if (finding.right != false) return;
  finding.right.reset();
  const std::size_t colon = finding.text.find(": ");
  finding.text =
      finding.part + ": not decidable from these images (" + finding.text.substr(colon + 2) + ", but " + why + ")";
}

}  // namespace

void judge_cloud(CloudCheckReport& report, const CloudCheckOptions& options, const Camera& camera) {
  const CloudRow& winner = row_of(report, report.winner);
  if (!report.believable) {
    if (!report.textured) {
      report.answer = CloudAnswer::undecided;
      report.verdict =
          "nothing can be said: too few of the cloud's points are seen on texture under any reading (no texture, or "
          "cloud and poses are not of one place)";
    } else {
      report.answer = CloudAnswer::differ;
      report.verdict = "no reading fits: the best leaves patches different by " +
                       formatted(
                           "%.2f (0: alike, 1: no relation); cloud and poses are not of one world, or cloud, scale "
                           "or camera are far off",
                           winner.relative_error);
    }
    return;
  }
  const bool fits = report.fits();
  const bool gains = report.correction_gains();
  if (report.unit != 1.0) {
    report.findings.push_back({"cloud unit", false,
                               "cloud unit: " + unit_words(report.unit) +
                                   formatted(", %.4g times as large as the poses say; the rest is said of it with that "
                                             "mended",
                                             report.unit)});
  }
  // If the cloud is not shown to fit, errors of the reading are reported only if patches do not agree at all under the
  // declared reading.
  const CloudRow& declared = row_of(report, report.declared);
  const bool readings_tell = fits || gains || !(declared.relative_error <= options.max_error);
  for (const Part& part : parts) {
    report.findings.push_back(part_finding(report, part, camera));
    if (!readings_tell) withdraw(report.findings.back(), "the cloud is not shown to fit");
  }
  bool measured = report.fit.has_value();
  if (report.fit) {
    for (CloudFinding& finding : fit_findings(*report.fit, options, camera)) {
      if (!gains) {
        withdraw(finding,
                 fits ? "patches agree no better with that mended" : "the cloud is not shown to fit with that mended");
      }
      const bool of_place = finding.part == "cloud scale" || finding.part == "cloud offset";
      if (of_place && !finding.right) measured = false;
      report.findings.push_back(finding);
    }
  }
  std::string differences;
  std::string open;
  for (const CloudFinding& finding : report.findings) {
    std::string& list = finding.right == false ? differences : open;
    if (!finding.text.empty()) list += (list.empty() ? "" : "; ") + finding.text;
  }
  if (!report.fit) open += std::string(open.empty() ? "" : "; ") + "too few patches are found again to measure more";
  if (!differences.empty()) {
    report.answer = CloudAnswer::differ;
    report.verdict = differences;
    if (!fits && !gains) report.verdict += "; beyond that, " + doubt_text(report, options);
  } else if (fits && measured) {
    report.answer = CloudAnswer::agree;
    report.verdict = formatted("images, poses and cloud agree, patches to %.2f", winner.relative_error);
  } else {
    report.answer = CloudAnswer::undecided;
    report.verdict = fits
                         ? "nothing is found to differ, but the cloud's scale or place is not known well enough to say "
                           "that it agrees"
                         : doubt_text(report, options);
  }
  if (!open.empty()) report.verdict += "; " + open;
}

std::string reading_text(const CloudReading& reading, const Camera& camera) {
  std::string text;
  for (const Part& part : parts) {
    text += (text.empty() ? "" : ", ") + std::string(part.name) + " " + part.text(reading, camera);
  }
  return text;
}

std::string cloud_table(const CloudCheckReport& report, const Camera& camera, std::size_t max_rows) {
  std::string table = "         fy  cloud's y  poses      id shift  difference  overlap %\n";
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    const CloudRow& row = report.rows[i];
    const bool is_declared = row.reading == report.declared;
    const bool is_winner = row.reading == report.winner;
    if (i >= max_rows && !is_declared && !is_winner) continue;
    table += formatted("%c%c %8s  %-9s  %-9s  %8s  %10s  %9.1f\n", is_winner ? '*' : ' ', is_declared ? 'd' : ' ',
                       parts[0].text(row.reading, camera).c_str(), parts[1].text(row.reading, camera).c_str(),
                       parts[2].text(row.reading, camera).c_str(), parts[3].text(row.reading, camera).c_str(),
                       std::isfinite(row.relative_error) ? formatted("%.3f", row.relative_error).c_str() : "-",
                       100.0 * row.overlap);
  }
  return table;
}

}  // namespace odosplat
