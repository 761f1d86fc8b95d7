// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/archive/compression.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr std::size_t piece = std::size_t{1} << 20U;  // decompressed at once [bytes]
constexpr int zstd_level = 12;                        // as the reference writer of SPZ
constexpr int gzip_window = 15 + 16;                  // the largest window; +16: with the header of gzip
constexpr int raw_window = -15;

/// A stream of zlib over bytes in memory, which may be more than the 4 GiB that zlib counts.
class Inflater {
 public:
  Inflater(std::string_view bytes, int window) : left_(bytes) {
    if (inflateInit2(&stream_, window) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Appends up to n bytes; fewer if the data end or are damaged.
  void append(std::string& to, std::size_t n) {
    while (n > 0 && !ended_) {
      const std::size_t part = std::min(n, piece);
      const std::size_t before = to.size();
      to.resize(before + part);
      stream_.next_out = reinterpret_cast<Bytef*>(to.data() + before);
      stream_.avail_out = static_cast<uInt>(part);
      while (stream_.avail_out > 0 && !ended_) step();
      const std::size_t made = part - stream_.avail_out;
      to.resize(before + made);
      n -= made;
    }
  }

  /// True once the compressed data say that they are complete.
  bool is_complete() const { return complete_; }

 private:
  void step() {
    const std::size_t most = std::min<std::size_t>(left_.size(), std::numeric_limits<uInt>::max());
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(left_.data()));
    stream_.avail_in = static_cast<uInt>(most);
    const uInt room = stream_.avail_out;
    const int result = inflate(&stream_, Z_NO_FLUSH);
    const std::size_t used = most - stream_.avail_in;
    left_.remove_prefix(used);
    complete_ = result == Z_STREAM_END;
    ended_ = result != Z_OK || (used == 0 && stream_.avail_out == room);
  }

  z_stream stream_{};
  std::string_view left_;
  bool ended_ = false;
  bool complete_ = false;
};

struct ZstdFree {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

}  // namespace

void require_plausible_size(const std::string& file, std::uint64_t declared, std::uint64_t stored) {
  if (declared / most_compression <= stored) return;
  throw InputError(file, "declares " + std::to_string(declared) + " bytes of data, more than its " +
                             std::to_string(stored) + " bytes can hold");
}

struct GzipStream::State {
  explicit State(std::string_view bytes) : inflater(bytes, gzip_window) {}
  Inflater inflater;
};

GzipStream::GzipStream(std::string file, std::string_view bytes)
    : file_(std::move(file)), state_(std::make_unique<State>(bytes)) {}

GzipStream::~GzipStream() = default;

std::string GzipStream::read(std::size_t n) {
  std::string bytes;
  state_->inflater.append(bytes, n);
  if (bytes.size() < n) {
    throw InputError(file_, state_->inflater.is_complete() ? "is cut off: its compressed data end too early"
                                                           : "is cut off or damaged: its gzip data cannot be read");
  }
  return bytes;
}

void GzipStream::finish() {
  std::string rest;
  do {
    rest.clear();
    state_->inflater.append(rest, piece);
  } while (rest.size() == piece);
  if (!state_->inflater.is_complete())
    throw InputError(file_, "is cut off or damaged: its gzip data have no valid end");
}

std::string inflated(const std::string& file, const std::string& place, std::string_view bytes, std::size_t size) {
  Inflater inflater(bytes, raw_window);
  std::string out;
  inflater.append(out, size);
  std::string more;
  if (out.size() == size) inflater.append(more, 1);  // also reads the end of the data
  if (out.size() < size || !inflater.is_complete() || !more.empty()) {
    throw InputError(file, place, "is damaged: its compressed data are not of the declared size");
  }
  return out;
}

std::string zstd_decompressed(const std::string& file, const std::string& place, std::string_view bytes,
                              std::size_t size) {
  const std::unique_ptr<ZSTD_DCtx, ZstdFree> context(ZSTD_createDCtx());
  if (context == nullptr) throw std::bad_alloc();
  std::string out;
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  std::size_t hint = 1;  // 0: the frame is complete
  while (out.size() <= size && (in.pos < in.size || hint != 0)) {
    const std::size_t before = out.size();
    const std::size_t part = std::min(size - before + 1, piece);  // one byte more shows that the data are too long
    out.resize(before + part);
    ZSTD_outBuffer to{out.data() + before, part, 0};
    const std::size_t had = in.pos;
    hint = ZSTD_decompressStream(context.get(), &to, &in);
    out.resize(before + to.pos);
    if (ZSTD_isError(hint) != 0U || (to.pos == 0 && in.pos == had)) break;
  }
  if (out.size() != size || hint != 0 || in.pos != in.size) {
    throw InputError(file, place, "is damaged: its zstd data are not of the declared size");
  }
  return out;
}

std::string zstd_compressed(std::string_view bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  const std::unique_ptr<ZSTD_CCtx, ZstdFree> context(ZSTD_createCCtx());
  if (context == nullptr) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, zstd_level);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  const std::size_t size = ZSTD_compress2(context.get(), out.data(), out.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size) != 0U) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

std::uint32_t crc32_of(std::string_view bytes) {
  uLong sum = crc32(0, nullptr, 0);
  while (!bytes.empty()) {
    const std::size_t part = std::min<std::size_t>(bytes.size(), piece);
    sum = crc32(sum, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(part));
    bytes.remove_prefix(part);
  }
  return static_cast<std::uint32_t>(sum);
}

}  // namespace odosplat
