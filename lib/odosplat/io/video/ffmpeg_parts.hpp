// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <memory>
#include <opencv2/core.hpp>
#include <string>

/// What VideoDecoder and LiveInput share: owners of FFmpeg's objects, and the conversion of its frames.
namespace odosplat::ffmpeg {

template <auto free_it>
struct Free {
  template <typename T>
  void operator()(T* pointer) const {
    free_it(&pointer);
  }
};
struct FreeScaler {
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};

using Format = std::unique_ptr<AVFormatContext, Free<avformat_close_input>>;
using Codec = std::unique_ptr<AVCodecContext, Free<avcodec_free_context>>;
using Packet = std::unique_ptr<AVPacket, Free<av_packet_free>>;
using Frame = std::unique_ptr<AVFrame, Free<av_frame_free>>;
using Scaler = std::unique_ptr<SwsContext, FreeScaler>;

/// FFmpeg's names of the formats that consist of a single file, for format_whitelist.
inline constexpr const char* single_files =
    "mov,matroska,avi,mpegts,mpeg,mpegvideo,m4v,ogg,flv,asf,mxf,nut,dv,ivf,h261,h263,h264,hevc,av1,obu,vc1,mjpeg,"
    "mjpeg_2000,gif,apng";

/// Clockwise quarter turns, 0 to 3, by which the stream's images are to be shown rotated. Throws InputError naming
/// `name` if they are to be shown mirrored, or rotated by an angle that is not a multiple of 90 degrees.
int quarters_shown(const std::string& name, const AVStream& stream);

/// Converts decoded frames to R, G, B, the same bits on every machine. Not thread safe.
class RgbConverter {
 public:
  /// The frame's image, rotated by that many quarters. Throws InputError naming `name` if it cannot be converted.
  cv::Mat3b image(const std::string& name, const AVFrame& frame, int quarters);

 private:
  Scaler scaler_;
};

}  // namespace odosplat::ffmpeg
