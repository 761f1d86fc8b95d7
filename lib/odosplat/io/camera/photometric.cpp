// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/camera/photometric.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <sstream>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/camera/camera_check.hpp"
#include "odosplat/io/image/image_container.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/text/file_names.hpp"
#include "odosplat/io/text/list_file.hpp"
#include "odosplat/io/text/text_rows.hpp"

namespace odosplat {
namespace {

constexpr float saturated = 254.5F / 255.0F;
constexpr double time_tolerance = 0.01;  // [s]
// Limits relative to the median. The ratio of a camera's longest to its shortest exposure is up to 1e5.
constexpr double least_exposure = 1e-6;
constexpr double most_exposure = 1e6;

// The numbers of a line that is not a comment.
struct NumberLine {
  std::size_t number;  // from 1
  std::vector<double> values;
};

// first_is_any_word: the first word need not be a number (DSO's ids); one that is not is stored as 0.
std::vector<NumberLine> number_lines(const std::string& name, const std::string& text, bool first_is_any_word) {
  std::vector<NumberLine> lines;
  std::istringstream in(text);
  LineReader reader(name, in);
  std::vector<std::string_view> words;
  for (std::string line; reader.next(line);) {
    split_words(line, ' ', words);
    if (words.empty() || words.front().front() == '#') continue;
    NumberLine row{reader.number(), {}};
    for (std::size_t i = 0; i < words.size(); ++i) {
      const std::optional<double> value = number_of(words[i]);
      if (!(value && std::isfinite(*value)) && !(i == 0 && first_is_any_word)) {
        reader.fail("`" + shown(words[i]) + "` is not a number");
      }
      row.values.push_back(value.value_or(0.0));
    }
    lines.push_back(std::move(row));
  }
  return lines;
}

// Whether the first line has DSO's form with an exposure: id, time, exposure.
bool lists_exposures(const std::string& name, const std::string& text) {
  std::istringstream in(text);
  LineReader reader(name, in);
  std::vector<std::string_view> words;
  for (std::string line; reader.next(line);) {
    split_words(line, ' ', words);
    if (words.empty() || words.front().front() == '#') continue;
    return words.size() == 3 && number_of(words[1]) && number_of(words[2]);
  }
  return false;
}

void require_positive(const std::string& name, const NumberLine& line, double exposure) {
  if (!(exposure > 0.0)) throw InputError(name, "line " + std::to_string(line.number), "the exposure is not positive");
}

void divide_by_median(const std::string& name, std::vector<double>& exposures) {
  if (exposures.empty()) return;
  const double median = upper_median(exposures);
  for (std::size_t i = 0; i < exposures.size(); ++i) {
    const double relative = exposures[i] / median;
    if (!(relative >= least_exposure && relative <= most_exposure)) {
      throw InputError(
          name, "frame " + std::to_string(i),
          formatted("its exposure %.6g is %.3g times the median, must be 1e-6..1e6 times it", exposures[i], relative));
    }
    exposures[i] = relative;
  }
}

}  // namespace

PhotometricCorrection::PhotometricCorrection(double gamma, const cv::Mat1f& vignette) : gamma_(gamma) {
  require(gamma >= camera_limits::least_gamma && gamma <= camera_limits::most_gamma, "gamma", "in 0.1..10");
  if (vignette.empty()) return;
  gain_.create(vignette.size());
  for (int y = 0; y < vignette.rows; ++y) {
    for (int x = 0; x < vignette.cols; ++x) {
      const double v = vignette(y, x);
      require(v >= 0.0 && v <= 1.0, "vignette", "in 0..1");
      gain_(y, x) = v > 0.0 ? static_cast<float>(std::pow(v, -1.0 / gamma)) : 0.0F;
    }
  }
}

ColorImage PhotometricCorrection::apply(const ColorImage& image, double exposure) const {
  require(exposure >= least_exposure && exposure <= most_exposure, "exposure", "in 1e-6..1e6 (1: the median)");
  if (gain_.empty() && exposure == 1.0) return image;
  if (!gain_.empty() && gain_.size() != image.size()) {
    throw InputError("vignette", "is " + std::to_string(gain_.cols) + "x" + std::to_string(gain_.rows) +
                                     ", the image is " + std::to_string(image.cols) + "x" + std::to_string(image.rows));
  }
  const auto of_exposure = static_cast<float>(std::pow(exposure, -1.0 / gamma_));
  ColorImage corrected(image.size());
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const float gain = gain_.empty() ? of_exposure : of_exposure * gain_(y, x);
      const cv::Vec3f& from = image(y, x);
      cv::Vec3f& to = corrected(y, x);
      for (int c = 0; c < 3; ++c)
        to[c] = from[c] >= saturated && gain > 0.0F ? from[c] : std::min(1.0F, gain * from[c]);
    }
  }
  return corrected;
}

cv::Mat1f read_vignette(const std::string& path, const ImageLimit& limit) {
  const std::string bytes = read_file(path, limit.max_bytes());
  const ImageContainer container = inspect_image(path, bytes);
  cv::Mat1f vignette;
  if (container.is_png && container.is_gray && container.bits == 16) {
    parse_depth_raw(path, bytes, limit).convertTo(vignette, CV_32F);
  } else {
    vignette = to_gray(parse_color(path, bytes, limit));
  }
  double largest = 0.0;
  cv::minMaxLoc(vignette, nullptr, &largest);
  if (!(largest > 0.0)) throw InputError(path, "is black everywhere: no vignette");
  for (float& v : vignette) v = std::min(1.0F, v / static_cast<float>(largest));
  return vignette;
}

std::vector<double> parse_exposures(const std::string& name, const std::string& text,
                                    const std::vector<double>& frame_times) {
  std::vector<double> times;
  std::vector<double> listed;
  for (const NumberLine& line : number_lines(name, text, false)) {
    const std::string place = "line " + std::to_string(line.number);
    if (line.values.size() != 2) throw InputError(name, place, "is not `time exposure`");
    require_positive(name, line, line.values[1]);
    if (!times.empty() && !(line.values[0] > times.back())) throw InputError(name, place, "times must grow");
    times.push_back(line.values[0]);
    listed.push_back(line.values[1]);
  }
  std::vector<double> exposures(frame_times.size(), 0.0);
  for (const auto& [i, j] : associate_by_time(frame_times, times, time_tolerance)) exposures[i] = listed[j];
  for (std::size_t i = 0; i < exposures.size(); ++i) {
    if (exposures[i] == 0.0) throw InputError(name, "has no exposure for frame " + std::to_string(i));
  }
  divide_by_median(name, exposures);
  return exposures;
}

std::vector<double> parse_dso_times(const std::string& name, const std::string& text, std::size_t frames) {
  std::vector<double> exposures;
  if (!lists_exposures(name, text)) return exposures;
  for (const NumberLine& line : number_lines(name, text, true)) {
    if (line.values.size() != 3) {
      throw InputError(name, "line " + std::to_string(line.number), "is not `id time exposure`");
    }
    require_positive(name, line, line.values[2]);
    exposures.push_back(line.values[2]);
  }
  if (exposures.size() != frames) {
    throw InputError(name, "lists " + std::to_string(exposures.size()) + " exposures, the sequence has " +
                               std::to_string(frames) + " frames");
  }
  divide_by_median(name, exposures);
  return exposures;
}

std::vector<double> read_exposures(const std::string& folder, const std::vector<double>& frame_times) {
  const std::string by_time = join(folder, "exposures.txt");
  if (file_exists(by_time)) return parse_exposures(by_time, read_file(by_time), frame_times);
  const std::string in_order = join(folder, "times.txt");
  if (file_exists(in_order)) return parse_dso_times(in_order, read_file(in_order), frame_times.size());
  return {};
}

}  // namespace odosplat
