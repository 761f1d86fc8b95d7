// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/image/picture_file.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <vector>

#include "odosplat/core/base64.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat {
namespace {

std::string ending(const std::string& path) {
  std::string text = std::filesystem::path(path).extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

std::string encoded(const std::string& format, const cv::Mat3b& rgb, const std::vector<int>& parameters = {}) {
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  std::vector<unsigned char> bytes;
  cv::imencode(format, bgr, bytes, parameters);
  return {bytes.begin(), bytes.end()};
}

/// The compressed rows of a PNG: the contents of its IDAT chunks, which a PDF can contain unchanged.
std::string compressed_rows(std::string_view png) {
  std::string rows;
  for (std::size_t at = 8; at + 12 <= png.size();) {
    std::uint32_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) size = size << 8U | static_cast<unsigned char>(png[at + i]);
    if (png.substr(at + 4, 4) == "IDAT") rows += png.substr(at + 8, size);
    at += 12 + static_cast<std::size_t>(size);
  }
  return rows;
}

/// The numbered objects of a PDF and the table of their offsets.
class Pdf {
 public:
  void add(const std::string& body) {
    starts_.push_back(text_.size());
    text_ += std::to_string(starts_.size()) + " 0 obj\n" + body + "\nendobj\n";
  }
  void add_stream(const std::string& entries, const std::string& bytes) {
    add("<< " + entries + " /Length " + std::to_string(bytes.size()) + " >>\nstream\n" + bytes + "\nendstream");
  }
  /// The whole file; object 1 is the catalogue.
  std::string finish() const {
    const std::string count = std::to_string(starts_.size() + 1);
    std::string file = text_ + "xref\n0 " + count + "\n0000000000 65535 f \n";
    for (const std::size_t start : starts_) file += formatted("%010zu 00000 n \n", start);
    return file + "trailer\n<< /Size " + count + " /Root 1 0 R >>\nstartxref\n" + std::to_string(text_.size()) +
           "\n%%EOF\n";
  }

 private:
  // Non-ASCII bytes in the second line mark the file as binary for programs that transfer files.
  std::string text_ = "%PDF-1.4\n%\xe2\xe3\xcf\xd3\n";
  std::vector<std::size_t> starts_;
};

std::string pdf_of(const cv::Mat3b& rgb) {
  const std::string width = std::to_string(rgb.cols);
  const std::string height = std::to_string(rgb.rows);
  // A point is 1/72 inch.
  const std::string w = formatted("%.2f", 0.75 * rgb.cols);
  const std::string h = formatted("%.2f", 0.75 * rgb.rows);
  Pdf pdf;
  pdf.add("<< /Type /Catalog /Pages 2 0 R >>");
  pdf.add("<< /Type /Pages /Kids [3 0 R] /Count 1 >>");
  pdf.add("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 " + w + " " + h +
          "] /Resources << /XObject << /Picture 4 0 R >> >> /Contents 5 0 R >>");
  pdf.add_stream("/Type /XObject /Subtype /Image /Width " + width + " /Height " + height +
                     " /ColorSpace /DeviceRGB /BitsPerComponent 8 /Filter /FlateDecode /DecodeParms << /Predictor 15 "
                     "/Colors 3 /BitsPerComponent 8 /Columns " +
                     width + " >>",
                 compressed_rows(encoded(".png", rgb)));
  pdf.add_stream("", "q " + w + " 0 0 " + h + " 0 0 cm /Picture Do Q");
  return pdf.finish();
}

std::string svg_of(const cv::Mat3b& rgb) {
  const std::string size = "width=\"" + std::to_string(rgb.cols) + "\" height=\"" + std::to_string(rgb.rows) + "\"";
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" " + size +
         ">\n<image " + size + " xlink:href=\"data:image/png;base64," + base64(encoded(".png", rgb)) + "\"/>\n</svg>\n";
}

}  // namespace

void check_picture_name(const std::string& path) {
  const std::string name = ending(path);
  for (const char* known : {".png", ".jpg", ".jpeg", ".pdf", ".svg"}) {
    if (name == known) return;
  }
  throw InputError(path, "a picture's name must end in .png, .jpg, .jpeg, .pdf or .svg");
}

void write_picture(const std::string& path, const cv::Mat3b& rgb) {
  check_picture_name(path);
  if (rgb.empty()) throw InputError(path, "cannot be written: the picture is empty");
  const std::string name = ending(path);
  write_file_atomically(path, name == ".pdf" ? pdf_of(rgb) : name == ".svg" ? svg_of(rgb) : encoded(name, rgb));
}

std::string jpeg_bytes(const cv::Mat3b& rgb, int quality) {
  if (rgb.empty()) throw InputError("picture", "is empty");
  return encoded(".jpg", rgb, {cv::IMWRITE_JPEG_QUALITY, quality});
}

}  // namespace odosplat
