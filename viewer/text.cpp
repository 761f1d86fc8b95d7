// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/text.hpp"

#include <vtkFreeTypeTools.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

namespace odosplat {
namespace {

constexpr int dots_per_inch = 72;  // so that a point is a pixel

std::string to_ascii(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) == 0x80U) continue;  // continuation byte of a UTF-8 character, which gives only one '?'
    result += byte >= 0x20U && byte < 0x7FU ? c : '?';
  }
  return result;
}

std::mutex& font_mutex() {
  static std::mutex mutex;
  return mutex;
}

void set_font(vtkTextProperty* property, int size) {
  property->SetFontFamilyToArial();
  property->SetFontSize(std::max(size, 4));
  property->SetColor(0.0, 0.0, 0.0);
  property->SetJustificationToLeft();
  property->SetVerticalJustificationToBottom();
}

}  // namespace

cv::Mat1b text_ink(const std::string& text, int size) {
  const std::string line = to_ascii(text);
  if (line.find_first_not_of(' ') == std::string::npos) return {};
  const std::lock_guard lock(font_mutex());
  vtkNew<vtkTextProperty> property;
  set_font(property, size);
  vtkNew<vtkImageData> image;
  int used[2] = {0, 0};
  if (!vtkFreeTypeTools::GetInstance()->RenderString(property, vtkStdString(line), dots_per_inch, image, used)) {
    throw std::runtime_error("VTK cannot draw the text \"" + line + "\"");
  }
  const int* dims = image->GetDimensions();
  const int channels = image->GetNumberOfScalarComponents();
  const auto* pixels = static_cast<const unsigned char*>(image->GetScalarPointer());
  cv::Mat1b ink(std::min(used[1], dims[1]), std::min(used[0], dims[0]));
  for (int y = 0; y < ink.rows; ++y) {
    for (int x = 0; x < ink.cols; ++x) {  // VTK's rows are ordered from the bottom
      ink(ink.rows - 1 - y, x) = pixels[(y * dims[0] + x) * channels + channels - 1];
    }
  }
  return ink;
}

int text_width(const std::string& text, int size) {
  const std::string line = to_ascii(text);
  if (line.empty()) return 0;
  const std::lock_guard lock(font_mutex());
  vtkNew<vtkTextProperty> property;
  set_font(property, size);
  int box[4] = {0, -1, 0, -1};
  vtkFreeTypeTools::GetInstance()->GetBoundingBox(property, vtkStdString(line), dots_per_inch, box);
  return box[1] - box[0] + 1;
}

FittedText fit_text(const std::string& text, int size, double max_width, double least) {
  FittedText fitted{to_ascii(text), size};
  const int smallest = std::max(4, static_cast<int>(std::lround(size * least)));
  while (fitted.size > smallest && text_width(fitted.text, fitted.size) > max_width) --fitted.size;
  if (text_width(fitted.text, fitted.size) <= max_width) return fitted;
  std::string head = fitted.text;
  while (!head.empty() && text_width(head + "...", fitted.size) > max_width) head.pop_back();
  fitted.text = head.empty() ? "" : head + "...";
  return fitted;
}

}  // namespace odosplat
