// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/video/live_input.hpp"

extern "C" {
#include <libavdevice/avdevice.h>
#include <libavutil/log.h>
}

#include <algorithm>
#include <chrono>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/video/live_address.hpp"
#include "odosplat/io/video/pipe_bytes.hpp"

namespace odosplat {
namespace {

using namespace ffmpeg;

constexpr int buffer_bytes = 32768;
constexpr std::int64_t longest_analysis = 2 * AV_TIME_BASE;  // of the stream's start, unless its parameters are known
constexpr auto device_pause = std::chrono::milliseconds(2);

// Text of an error of FFmpeg's.
std::string reason_of(int error) {
  char text[AV_ERROR_MAX_STRING_SIZE] = "";
  av_strerror(error, text, sizeof(text));
  return text;
}

struct FreeIo {
  void operator()(AVIOContext* io) const {
    av_freep(&io->buffer);
    avio_context_free(&io);
  }
};

}  // namespace

struct LiveInput::State {
  std::string source;
  std::string shown;
  LiveKind kind = LiveKind::none;
  std::function<bool()> given_up;
  // Destroyed from below: codec and format use what is above them.
  std::unique_ptr<PipeBytes> pipe;
  std::unique_ptr<AVIOContext, FreeIo> io;
  Format format;
  Codec codec;
  Packet packet{av_packet_alloc()};
  Frame frame{av_frame_alloc()};
  int stream = -1;
  int quarters = 0;
  bool has_stamps = true;
  long damaged = 0;
  std::string fault;

  [[noreturn]] void fail(const std::string& reason) const { throw InputError(shown, reason); }
  const AVStream& video() const { return *format->streams[stream]; }

  static int interrupt(void* state) { return static_cast<State*>(state)->given_up() ? 1 : 0; }

  static int read_pipe(void* state, std::uint8_t* to, int most) {
    int count = 0;
    switch (static_cast<State*>(state)->pipe->read(to, static_cast<std::size_t>(most), count)) {
      case PipeBytes::Result::bytes:
        return count;
      case PipeBytes::Result::end:
        return AVERROR_EOF;
      case PipeBytes::Result::given_up:
        return AVERROR_EXIT;
      case PipeBytes::Result::failed:
        break;
    }
    return AVERROR(count);
  }

  void open_pipe(AVDictionary** options) {
    pipe = std::make_unique<PipeBytes>(source, given_up);
    auto* buffer = static_cast<std::uint8_t*>(av_malloc(buffer_bytes));
    io.reset(avio_alloc_context(buffer, buffer_bytes, 0, this, read_pipe, nullptr, nullptr));
    format->pb = io.get();
    // As for files: no playlist or list may name something else to open.
    av_dict_set(options, "protocol_whitelist", "pipe", 0);
    av_dict_set(options, "format_whitelist", single_files, 0);
    av_dict_set(options, "format_whitelist", ",yuv4mpegpipe", AV_DICT_APPEND);
  }

  void open(const LiveOptions& wishes) {
    format.reset(avformat_alloc_context());
    if (format == nullptr) fail("there is too little memory");
    format->interrupt_callback = {interrupt, this};
    format->max_analyze_duration = longest_analysis;
    AVDictionary* options = nullptr;
    const AVInputFormat* input = nullptr;
    std::string address = source;
    if (kind == LiveKind::pipe) {
      open_pipe(&options);
      address.clear();
    } else if (kind == LiveKind::device) {
      static std::once_flag registered;
      std::call_once(registered, [] { avdevice_register_all(); });
      input = av_find_input_format("video4linux2");
      if (input == nullptr) fail("this FFmpeg reads no cameras (Video4Linux)");
      format->flags |= AVFMT_FLAG_NONBLOCK;  // else reading cannot be interrupted
      if (wishes.size.area() > 0) {
        const std::string size = std::to_string(wishes.size.width) + "x" + std::to_string(wishes.size.height);
        av_dict_set(&options, "video_size", size.c_str(), 0);
      }
    } else {
      av_dict_set(&options, "rtsp_flags", "prefer_tcp", 0);  // lost packets of UDP damage images
    }
    AVFormatContext* opening = format.release();
    const int opened = avformat_open_input(&opening, address.c_str(), input, &options);
    av_dict_free(&options);
    if (opened < 0) fail("cannot be opened: " + reason_of(opened));  // avformat_open_input has freed the context
    format.reset(opening);
  }

  void choose_stream(const LiveOptions& wishes) {
    if (const int found = avformat_find_stream_info(format.get(), nullptr); found < 0) {
      fail("holds no video: " + reason_of(found));
    }
    const AVCodec* decoder = nullptr;
    stream = av_find_best_stream(format.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &decoder, 0);
    if (stream < 0 || decoder == nullptr || decoder->id == AV_CODEC_ID_ANSI) fail("holds no video that can be decoded");
    for (unsigned i = 0; i < format->nb_streams; ++i) {
      if (static_cast<int>(i) != stream) format->streams[i]->discard = AVDISCARD_ALL;
    }
    quarters = quarters_shown(shown, video());
    const AVCodecParameters& coded = *video().codecpar;
    if (coded.width > 0 && coded.height > 0) {
      ImageLimit{wishes.max_pixels, {}}.check(shown, cv::Size(coded.width, coded.height));
    }
    // FFmpeg makes up stamps, by a rate, for formats that have none.
    const std::string_view name = format->iformat->name;
    has_stamps = (format->iformat->flags & AVFMT_NOTIMESTAMPS) == 0 && name != "mpjpeg";
    codec.reset(avcodec_alloc_context3(decoder));
    if (codec == nullptr || avcodec_parameters_to_context(codec.get(), video().codecpar) < 0) {
      fail("its images cannot be decoded");
    }
    codec->pkt_timebase = video().time_base;
    codec->max_pixels = wishes.max_pixels;
    // Threads that decode one frame each would delay every image by as many images as there are threads.
    codec->thread_count = 0;
    codec->thread_type = FF_THREAD_SLICE;
    if (avcodec_open2(codec.get(), decoder, nullptr) < 0) fail("its images cannot be decoded");
  }

  // Gives the codec the next packet, or the end of the stream. False: failed or given up.
  bool feed() {
    while (true) {
      const int read = av_read_frame(format.get(), packet.get());
      if (read == AVERROR(EAGAIN)) {
        if (given_up()) return false;
        std::this_thread::sleep_for(device_pause);
        continue;
      }
      if (read == AVERROR_EOF && !given_up()) {
        if (format->pb != nullptr && format->pb->error < 0 && format->pb->error != AVERROR_EOF) {
          fault = reason_of(format->pb->error);
        }
        avcodec_send_packet(codec.get(), nullptr);
        return true;
      }
      if (read < 0) {
        if (!given_up()) fault = reason_of(read);
        return false;
      }
      const bool ours = packet->stream_index == stream;
      if (ours && avcodec_send_packet(codec.get(), packet.get()) < 0) ++damaged;
      av_packet_unref(packet.get());
      if (ours) return true;
    }
  }
};

LiveInput::LiveInput(const std::string& source, const LiveOptions& options, std::function<bool()> given_up)
    : state_(std::make_unique<State>()) {
  av_log_set_level(AV_LOG_QUIET);  // its messages may hold passwords; the InputError says what is wrong
  State& s = *state_;
  s.source = source;
  s.shown = shown_address(source);
  s.kind = live_kind(source);
  s.given_up = std::move(given_up);
  s.open(options);
  s.choose_stream(options);
}

LiveInput::~LiveInput() = default;

bool LiveInput::next() {
  State& s = *state_;
  while (!s.given_up()) {
    const int received = avcodec_receive_frame(s.codec.get(), s.frame.get());
    if (received == AVERROR_EOF) return false;
    if (received == 0) {
      if ((s.frame->flags & AV_FRAME_FLAG_CORRUPT) == 0 && s.frame->decode_error_flags == 0) return true;
      ++s.damaged;
    } else if (received != AVERROR(EAGAIN)) {
      ++s.damaged;
    }
    if (!s.feed()) return false;
  }
  return false;
}

const std::string& LiveInput::fault() const { return state_->fault; }
long LiveInput::damaged() const { return state_->damaged; }
int LiveInput::quarters() const { return state_->quarters; }

ffmpeg::Frame LiveInput::frame() const {
  const AVFrame& decoded = *state_->frame;
  // A camera's frames lie in memory of its driver, which goes when the camera is closed.
  if (state_->kind != LiveKind::device) return Frame(av_frame_clone(&decoded));
  Frame copy(av_frame_alloc());
  if (copy == nullptr) return nullptr;
  copy->format = decoded.format;
  copy->width = decoded.width;
  copy->height = decoded.height;
  const bool copied = av_frame_get_buffer(copy.get(), 0) >= 0 && av_frame_copy(copy.get(), &decoded) >= 0 &&
                      av_frame_copy_props(copy.get(), &decoded) >= 0;
  return copied ? std::move(copy) : nullptr;
}

std::optional<double> LiveInput::stamp() const {
  if (!state_->has_stamps) return std::nullopt;
  const std::int64_t stamp = state_->frame->best_effort_timestamp;
  if (stamp == AV_NOPTS_VALUE) return std::nullopt;
  return static_cast<double>(stamp) * av_q2d(state_->video().time_base);
}

}  // namespace odosplat
