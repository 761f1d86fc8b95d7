// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/video/video_reader.hpp"

#include <cmath>
#include <mutex>
#include <optional>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/image/size_text.hpp"
#include "odosplat/io/video/video_decoder.hpp"

namespace odosplat {
namespace {

constexpr double same_step = 1e-3;  // [s] containers round their stamps

// The result of a pass through the whole file.
struct Pass {
  std::vector<std::optional<double>> times;
  std::vector<std::optional<double>> best_times;
  cv::Size frame_size;
};

Pass read_all(const std::string& path, VideoDecoder& decoder, const std::function<void(double share)>& progress) {
  Pass pass;
  while (decoder.next()) {
    if (pass.times.empty()) pass.frame_size = decoder.size();
    if (decoder.size() != pass.frame_size) {
      throw InputError(path, "frame " + std::to_string(pass.times.size()),
                       "is " + size_text(decoder.size()) + ", those before are " + size_text(pass.frame_size));
    }
    pass.times.push_back(decoder.time());
    pass.best_times.push_back(decoder.best_time());
    if (progress) progress(decoder.share_read());
  }
  if (pass.times.empty()) throw InputError(path, "holds no frame");
  return pass;
}

// Logs one line about images that the file declares but that are missing or damaged.
void warn_of_damage(const std::string& path, const VideoDecoder::Damage& damage, std::size_t frames) {
  if (!damage.any()) return;
  std::string faults;
  const auto add = [&faults](const std::string& fault) { faults += (faults.empty() ? "" : ", ") + fault; };
  if (damage.missing > 0) add(std::to_string(damage.missing) + " that the file declares are missing");
  if (damage.missing_s > 0.0) add(formatted("it ends %.2f s before its header says", damage.missing_s));
  if (damage.undecoded > 0) add(std::to_string(damage.undecoded) + " cannot be decoded and are left out");
  if (damage.corrupt > 0) add(std::to_string(damage.corrupt) + " are decoded from damaged data");
  log_warning(path + ": is damaged or cut off: " + std::to_string(frames) + " images are read, " + faults +
              (damage.shifts_stamps ? "; its stamps count the images, so that those behind a missing one are "
                                      "too early"
                                    : ""));
}

bool are_all_known(const std::vector<std::optional<double>>& times) {
  for (const std::optional<double>& time : times) {
    if (!time) return false;
  }
  return true;
}

// True if all known times lie on one regular grid with spacing `step`, within the rounding of stamps.
bool is_regular(const std::vector<std::optional<double>>& times, double step) {
  std::optional<double> first;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (!times[k]) continue;
    const double start = *times[k] - static_cast<double>(k) * step;
    if (!first) first = start;
    if (!(std::abs(start - *first) <= same_step)) return false;
  }
  return true;
}

std::vector<double> times_of(const std::string& path, const Pass& pass, double rate) {
  std::vector<double> times;
  if (are_all_known(pass.times)) {
    for (const std::optional<double>& time : pass.times) times.push_back(*time);
  } else {
    if (!(rate > 0.0) || !is_regular(pass.best_times, 1.0 / rate)) {
      throw InputError(path,
                       "has no presentation stamps, and its images do not come at a constant rate; MP4 and "
                       "Matroska (.mkv) hold stamps");
    }
    for (std::size_t k = 0; k < pass.times.size(); ++k) times.push_back(static_cast<double>(k) / rate);
  }
  for (std::size_t k = 1; k < times.size(); ++k) {
    if (!(times[k] > times[k - 1])) {
      throw InputError(path, "frame " + std::to_string(k),
                       "its stamp " + std::to_string(times[k]) + " s is not after " + std::to_string(times[k - 1]));
    }
  }
  return times;
}

}  // namespace

struct VideoReader::State {
  std::string path;
  std::size_t size = 0;
  cv::Size frame_size;
  int quarters = 0;
  std::vector<double> times;
  std::mutex mutex;
  std::optional<VideoDecoder> decoder;
  std::size_t next = 0;  // number of the frame that the decoder returns next
};

VideoReader::VideoReader(std::string path, const std::function<void(double share)>& progress)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.path = std::move(path);
  require_regular_file(s.path);
  VideoDecoder decoder(s.path);
  const Pass pass = read_all(s.path, decoder, progress);
  warn_of_damage(s.path, decoder.damage(), pass.times.size());
  s.size = pass.times.size();
  s.frame_size = pass.frame_size;
  s.quarters = decoder.quarters();
  if (decoder.has_stamps()) s.times = times_of(s.path, pass, decoder.rate());
}

VideoReader::~VideoReader() = default;

std::size_t VideoReader::size() const { return state_->size; }
cv::Size VideoReader::frame_size() const { return state_->frame_size; }
int VideoReader::quarters() const { return state_->quarters; }
const std::vector<double>& VideoReader::times() const { return state_->times; }

cv::Mat3b VideoReader::frame(std::size_t i) const {
  State& s = *state_;
  const std::lock_guard lock(s.mutex);
  if (!s.decoder || i < s.next) {
    s.decoder.emplace(s.path);
    s.next = 0;
  }
  for (; s.next <= i; ++s.next) {
    if (!s.decoder->next()) throw InputError(s.path, "frame " + std::to_string(i), "cannot be decoded");
  }
  return s.decoder->image();
}

}  // namespace odosplat
