// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/view/web/page_images.hpp"

#include <algorithm>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "apps/cli/view/web/page_paths.hpp"
#include "apps/command/interrupt.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/image/picture_file.hpp"

namespace odosplat::apps {
namespace {

constexpr int quality = 80;  // of JPEG

std::string thumbnail(const ColorImage& color, int longer_side) {
  const double scale = std::min(1.0, static_cast<double>(longer_side) / std::max(color.cols, color.rows));
  cv::Mat3f small = color;
  if (scale < 1.0) {
    const cv::Size size(std::max(1, cvRound(scale * color.cols)), std::max(1, cvRound(scale * color.rows)));
    cv::resize(color, small, size, 0.0, 0.0, cv::INTER_AREA);
  }
  cv::Mat3b bytes;
  small.convertTo(bytes, CV_8U, 255.0);
  return jpeg_bytes(bytes, quality);
}

}  // namespace

std::vector<PageImage> read_page_images(const Sequence& sequence, std::size_t begin, std::size_t end,
                                        const std::vector<double>& times, std::size_t most, int longer_side) {
  std::vector<std::pair<std::size_t, std::size_t>> found;  // image, frame
  for (std::size_t i = begin; i < std::min(end, sequence.size()); ++i) {
    if (const auto frame = page_frame(times, sequence.time(i))) found.emplace_back(i, *frame);
  }
  if (found.empty()) throw InputError(sequence.name(), "no image has the time of a pose or a row of status.csv");
  std::vector<PageImage> images;
  std::string fault;
  std::size_t unreadable = 0;
  const std::size_t count = std::min(most, found.size());
  Progress progress("images", static_cast<long>(count));
  for (std::size_t k = 0; k < count; ++k) {
    if (interrupted()) throw Interrupted();
    // The first and the last are among them.
    const std::size_t step = count > 1 ? k * (found.size() - 1) / (count - 1) : 0;
    const auto [i, frame] = found[step];
    try {
      const std::string name = std::filesystem::path(sequence.color_file(i)).filename().string();
      images.push_back({frame, name, thumbnail(sequence.color(i), longer_side)});
    } catch (const InputError& e) {
      if (unreadable++ == 0) fault = e.what();
    }
    progress.update(static_cast<long>(k) + 1);
  }
  progress.finish();
  if (images.empty() && unreadable > 0) throw InputError(fault);
  if (unreadable > 0) {
    log_warning(std::to_string(unreadable) + " of " + std::to_string(count) +
                " images are left out, the first: " + fault);
  }
  return images;
}

}  // namespace odosplat::apps
