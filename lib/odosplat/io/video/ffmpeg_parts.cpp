// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/video/ffmpeg_parts.hpp"

extern "C" {
#include <libavutil/display.h>
}

#include <cmath>
#include <cstdint>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat::ffmpeg {
namespace {

// The 3x3 display matrix in 16.16 and 2.30 fixed point; null if there is none.
const std::int32_t* display_matrix(const AVStream& stream) {
#if LIBAVFORMAT_VERSION_MAJOR >= 61
  const AVPacketSideData* data = av_packet_side_data_get(
      stream.codecpar->coded_side_data, stream.codecpar->nb_coded_side_data, AV_PKT_DATA_DISPLAYMATRIX);
  return data == nullptr ? nullptr : reinterpret_cast<const std::int32_t*>(data->data);
#else
  return reinterpret_cast<const std::int32_t*>(av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr));
#endif
}

}  // namespace

int quarters_shown(const std::string& name, const AVStream& stream) {
  const std::int32_t* m = display_matrix(stream);
  if (m == nullptr) return 0;
  const double determinant = static_cast<double>(m[0]) * m[4] - static_cast<double>(m[1]) * m[3];
  if (determinant < 0.0) throw InputError(name, "is marked to be shown mirrored, which is not supported");
  const double clockwise = -av_display_rotation_get(m);
  const double quarters = std::round(clockwise / 90.0);
  if (!(std::abs(clockwise - 90.0 * quarters) < 0.1)) {
    throw InputError(name, formatted("is to be shown turned by %.1f degrees, which is no multiple of 90", clockwise));
  }
  return static_cast<int>(quarters + 4.0) % 4;
}

cv::Mat3b RgbConverter::image(const std::string& name, const AVFrame& frame, int quarters) {
  scaler_.reset(sws_getCachedContext(
      scaler_.release(), frame.width, frame.height, static_cast<AVPixelFormat>(frame.format), frame.width, frame.height,
      AV_PIX_FMT_RGB24, SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_BITEXACT, nullptr, nullptr, nullptr));
  if (scaler_ == nullptr) throw InputError(name, "its pixel format cannot be converted to R, G, B");
  int* inverse = nullptr;
  int* table = nullptr;
  int full_range = 0;
  int rgb_range = 0;
  int brightness = 0;
  int contrast = 0;
  int saturation = 0;
  if (sws_getColorspaceDetails(scaler_.get(), &inverse, &full_range, &table, &rgb_range, &brightness, &contrast,
                               &saturation) >= 0) {
    if (frame.color_range == AVCOL_RANGE_JPEG) full_range = 1;
    sws_setColorspaceDetails(scaler_.get(), sws_getCoefficients(frame.colorspace), full_range, table, rgb_range,
                             brightness, contrast, saturation);
  }
  cv::Mat3b stored(frame.height, frame.width);
  std::uint8_t* const planes[4] = {stored.data, nullptr, nullptr, nullptr};
  const int steps[4] = {static_cast<int>(stored.step), 0, 0, 0};
  if (sws_scale(scaler_.get(), frame.data, frame.linesize, 0, frame.height, planes, steps) != frame.height) {
    throw InputError(name, "a frame cannot be converted to R, G, B");
  }
  if (quarters == 0) return stored;
  cv::Mat3b turned;
  cv::rotate(stored, turned, quarters - 1);  // codes 0, 1, 2: 90, 180, 270 degrees clockwise
  return turned;
}

}  // namespace odosplat::ffmpeg
