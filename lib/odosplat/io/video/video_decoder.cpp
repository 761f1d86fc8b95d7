// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/video/video_decoder.hpp"

extern "C" {
#include <libavutil/log.h>
}

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/io/video/ffmpeg_parts.hpp"

namespace odosplat {
namespace {

using namespace ffmpeg;

[[noreturn]] void no_video(const std::string& path) { throw InputError(path, "is not a video that can be read"); }

// Opens the file. flags: of AVFormatContext.
Format open_format(const std::string& path, int flags) {
  AVFormatContext* format = avformat_alloc_context();
  if (format == nullptr) no_video(path);
  format->flags |= flags;
  AVDictionary* options = nullptr;
  // Playlists and lists are excluded: FFmpeg would open the files, pipes and addresses that they name as soon as it
  // reads the header.
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  av_dict_set(&options, "format_whitelist", single_files, 0);
  const int opened = avformat_open_input(&format, ("file:" + path).c_str(), nullptr, &options);
  av_dict_free(&options);
  if (opened < 0) no_video(path);  // avformat_open_input has freed the context
  return Format(format);
}

// Whether packets have stamps. Bare streams (.h264, .mjpeg) have none; without these flags FFmpeg would generate stamps
// from a rate.
bool holds_stamps(const std::string& path) {
  constexpr int enough_packets = 64;
  const Format format = open_format(path, AVFMT_FLAG_NOFILLIN | AVFMT_FLAG_NOPARSE);
  const Packet packet(av_packet_alloc());
  for (int i = 0; i < enough_packets && av_read_frame(format.get(), packet.get()) >= 0; ++i) {
    const bool stamped = packet->pts != AV_NOPTS_VALUE || packet->dts != AV_NOPTS_VALUE;
    av_packet_unref(packet.get());
    if (stamped) return true;
  }
  return false;
}

}  // namespace

struct VideoDecoder::State {
  std::string path;
  Format format;
  Codec codec;
  int stream = -1;
  int quarters = 0;
  Packet packet{av_packet_alloc()};
  Frame frame{av_frame_alloc()};
  RgbConverter converter;
  // Declared by the container: number of images by its index (0: no index) and by its header (AVI: including entries
  // that repeat an image), and its duration [s].
  long indexed = 0;
  long declared = 0;
  double declared_s = 0.0;
  bool is_avi = false;
  // Found in the file.
  long packets = 0;
  std::int64_t end = 0;  // end of the last image, in the stream's time base
  long undecoded = 0;
  long corrupt = 0;

  const AVStream& video() const { return *format->streams[stream]; }
  std::optional<double> seconds(std::int64_t stamp) const {
    if (stamp == AV_NOPTS_VALUE) return std::nullopt;
    return static_cast<double>(stamp) * av_q2d(video().time_base);
  }

  // Gives the codec the next packet, or signals the end of the stream.
  void feed() {
    while (av_read_frame(format.get(), packet.get()) >= 0) {
      const bool ours = packet->stream_index == stream;
      if (ours) {
        note(*packet);
        if (avcodec_send_packet(codec.get(), packet.get()) < 0) ++undecoded;
      }
      av_packet_unref(packet.get());
      if (ours) return;
    }
    avcodec_send_packet(codec.get(), nullptr);
  }

  void note(const AVPacket& taken) {
    const std::int64_t start = taken.pts != AV_NOPTS_VALUE && !is_avi ? taken.pts : taken.dts;
    // The time of an AVI increases by one per image or repetition; its packets have no duration.
    const std::int64_t duration = std::max<std::int64_t>(taken.duration, is_avi ? 1 : 0);
    if (start != AV_NOPTS_VALUE) end = std::max(end, start + duration);
    ++packets;
  }

  // entries: number of images in the index of each stream before any packet is read. FFmpeg adds packets that it reads
  // to the index later.
  void note_promises(const std::vector<long>& entries) {
    is_avi = std::string_view(format->iformat->name) == "avi";
    // In some formats (FLV, MPEG) streams are found only while packets are read, so `entries` may be shorter.
    const auto at = static_cast<std::size_t>(stream);
    indexed = at < entries.size() ? entries[at] : 0;
    if (is_avi) declared = static_cast<long>(video().nb_frames);
    note_length();
  }

  // Matroska declares the duration of its video stream, or that of all streams together. For transport streams the
  // duration is FFmpeg's own measurement and says nothing about missing data.
  void note_length() {
    const AVDictionaryEntry* tag = av_dict_get(video().metadata, "DURATION", nullptr, 0);
    int hours = 0;
    int minutes = 0;
    double rest = 0.0;
    if (tag != nullptr && std::sscanf(tag->value, "%d:%d:%lf", &hours, &minutes, &rest) == 3) {
      declared_s = 3600.0 * hours + 60.0 * minutes + rest;
    } else if (format->nb_streams == 1 && format->duration != AV_NOPTS_VALUE &&
               format->duration_estimation_method == AVFMT_DURATION_FROM_STREAM) {
      declared_s = static_cast<double>(format->duration) / AV_TIME_BASE;
      if (format->start_time != AV_NOPTS_VALUE) declared_s += static_cast<double>(format->start_time) / AV_TIME_BASE;
    }
  }
};

VideoDecoder::VideoDecoder(const std::string& path) : state_(std::make_unique<State>()) {
  av_log_set_level(AV_LOG_QUIET);  // the InputError tells the user what is wrong
  State& s = *state_;
  s.path = path;
  s.format = open_format(path, 0);
  std::vector<long> indexed;
  for (unsigned i = 0; i < s.format->nb_streams; ++i)
    indexed.push_back(avformat_index_get_entries_count(s.format->streams[i]));
  if (avformat_find_stream_info(s.format.get(), nullptr) < 0) no_video(path);
  const AVCodec* decoder = nullptr;
  s.stream = av_find_best_stream(s.format.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &decoder, 0);
  // Cover images of music files and ANSI text rendered as a screen do not count as videos.
  if (s.stream < 0 || decoder == nullptr || decoder->id == AV_CODEC_ID_ANSI ||
      (s.video().disposition & AV_DISPOSITION_ATTACHED_PIC) != 0) {
    no_video(path);
  }
  for (unsigned i = 0; i < s.format->nb_streams; ++i) {
    if (static_cast<int>(i) != s.stream) s.format->streams[i]->discard = AVDISCARD_ALL;
  }
  s.note_promises(indexed);
  s.quarters = quarters_shown(path, s.video());
  s.codec.reset(avcodec_alloc_context3(decoder));
  if (s.codec == nullptr || avcodec_parameters_to_context(s.codec.get(), s.video().codecpar) < 0) no_video(path);
  s.codec->pkt_timebase = s.video().time_base;
  s.codec->thread_count = 0;
  if (avcodec_open2(s.codec.get(), decoder, nullptr) < 0) no_video(path);
}

VideoDecoder::~VideoDecoder() = default;
VideoDecoder::VideoDecoder(VideoDecoder&&) noexcept = default;
VideoDecoder& VideoDecoder::operator=(VideoDecoder&&) noexcept = default;

int VideoDecoder::quarters() const { return state_->quarters; }
bool VideoDecoder::has_stamps() const { return holds_stamps(state_->path); }

double VideoDecoder::rate() const {
  const AVRational rate = av_guess_frame_rate(state_->format.get(), state_->format->streams[state_->stream], nullptr);
  return rate.num > 0 && rate.den > 0 ? av_q2d(rate) : 0.0;
}

bool VideoDecoder::next() {
  State& s = *state_;
  while (true) {
    const int received = avcodec_receive_frame(s.codec.get(), s.frame.get());
    if (received == 0) {
      if ((s.frame->flags & AV_FRAME_FLAG_CORRUPT) != 0 || s.frame->decode_error_flags != 0) ++s.corrupt;
      return true;
    }
    if (received == AVERROR_EOF) return false;
    if (received != AVERROR(EAGAIN)) ++s.undecoded;
    s.feed();
  }
}

double VideoDecoder::share_read() const {
  AVIOContext* file = state_->format->pb;
  const std::int64_t size = file != nullptr ? avio_size(file) : 0;
  return size > 0 ? std::clamp(static_cast<double>(avio_tell(file)) / static_cast<double>(size), 0.0, 1.0) : 0.0;
}

VideoDecoder::Damage VideoDecoder::damage() const {
  const State& s = *state_;
  Damage damage;
  damage.undecoded = s.undecoded;
  damage.corrupt = s.corrupt;
  damage.missing = std::max(0L, s.indexed - s.packets);
  // The stamps of an AVI count its images and repetitions, so s.end is their number.
  if (s.is_avi) damage.missing = std::max({0L, damage.missing, s.declared - static_cast<long>(s.end)});
  damage.shifts_stamps = s.is_avi && damage.missing > 0;
  const double end_s = s.seconds(s.end).value_or(0.0);
  const double image_s = rate() > 0.0 ? 1.0 / rate() : 0.0;
  // A tolerance of 1.5 images, because the duration of the last image is often unknown and then not included in `end`.
  if (damage.missing == 0 && s.declared_s - end_s > 1.5 * image_s + 0.01) damage.missing_s = s.declared_s - end_s;
  return damage;
}

std::optional<double> VideoDecoder::time() const { return state_->seconds(state_->frame->pts); }
std::optional<double> VideoDecoder::best_time() const {
  const std::optional<double> stamp = time();
  return stamp ? stamp : state_->seconds(state_->frame->best_effort_timestamp);
}

cv::Size VideoDecoder::size() const {
  const cv::Size stored(state_->frame->width, state_->frame->height);
  return state_->quarters % 2 == 0 ? stored : cv::Size(stored.height, stored.width);
}

cv::Mat3b VideoDecoder::image() const {
  return state_->converter.image(state_->path, *state_->frame, state_->quarters);
}

}  // namespace odosplat
