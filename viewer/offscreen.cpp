// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/offscreen.hpp"

#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkCullerCollection.h>
#include <vtkFloatArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "viewer/egl_context.hpp"

namespace odosplat {
namespace {

constexpr int samples = 2;           // per pixel, in each direction
constexpr int largest_tile = 4096;   // [samples] in each direction
constexpr double near_share = 1e-3;  // of the far plane's distance; 24-bit depth still resolves 1e-4 there

struct DepthRange {
  double near = 0.1;
  double far = 1.0;
};

DepthRange depth_range(const std::vector<FigureLayer>& layers, const FigureView& view) {
  const SE3 T_view_world = view.T_world_view.inverse();
  double low = std::numeric_limits<double>::max();
  double high = -low;
  for (const auto& layer : layers) {
    for (const auto& vertex : layer.mesh.vertices()) {
      const double z = (T_view_world * (vertex.cast<double>() + layer.mesh.origin())).z();
      low = std::min(low, z);
      high = std::max(high, z);
    }
  }
  if (low > high) return {};
  const double slack = 1e-3 * (high - low) + 1e-6;
  DepthRange range{low - slack, high + slack};
  if (view.perspective) {
    range.far = std::max(range.far, 1e-6);
    range.near = std::max(range.near, near_share * range.far);
  }
  return range;
}

/// OpenGL's projection matrix of the part of the view that starts at sample `corner` and has the size `tile`, for eye
/// coordinates x right, y up, z backward.
vtkSmartPointer<vtkMatrix4x4> projection(const FigureView& view, cv::Point corner, cv::Size tile, DepthRange range) {
  const double focal = samples * view.focal;
  const double offset_x = 2.0 * (samples * (view.cx + 0.5) - corner.x) / tile.width - 1.0;
  const double offset_y = 2.0 * (samples * (view.cy + 0.5) - corner.y) / tile.height - 1.0;
  const double depth = range.far - range.near;
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  matrix->Zero();
  matrix->SetElement(0, 0, 2.0 * focal / tile.width);
  matrix->SetElement(1, 1, 2.0 * focal / tile.height);
  matrix->SetElement(0, view.perspective ? 2 : 3, view.perspective ? -offset_x : offset_x);
  matrix->SetElement(1, view.perspective ? 2 : 3, view.perspective ? offset_y : -offset_y);
  if (view.perspective) {
    matrix->SetElement(2, 2, -(range.far + range.near) / depth);
    matrix->SetElement(2, 3, -2.0 * range.far * range.near / depth);
    matrix->SetElement(3, 2, -1.0);
  } else {
    matrix->SetElement(2, 2, -2.0 / depth);
    matrix->SetElement(2, 3, -(range.far + range.near) / depth);
    matrix->SetElement(3, 3, 1.0);
  }
  return matrix;
}

vtkSmartPointer<vtkPolyData> to_poly_data(const FigureMesh& mesh) {
  const auto count = static_cast<vtkIdType>(mesh.vertices().size());
  vtkNew<vtkFloatArray> positions;
  positions->SetNumberOfComponents(3);
  positions->SetNumberOfTuples(count);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    std::copy_n(mesh.vertices()[k].data(), 3, positions->GetPointer(3 * i));
    std::copy_n(mesh.colors()[k].val, 3, colors->GetPointer(3 * i));
  }
  const auto triangles = static_cast<vtkIdType>(mesh.triangles().size());
  vtkNew<vtkTypeInt32Array> offsets;
  offsets->SetNumberOfValues(triangles + 1);
  vtkNew<vtkTypeInt32Array> indices;
  indices->SetNumberOfValues(3 * triangles);
  for (vtkIdType i = 0; i < triangles; ++i) {
    offsets->SetValue(i, static_cast<vtkTypeInt32>(3 * i));
    std::copy_n(mesh.triangles()[static_cast<std::size_t>(i)].data(), 3, indices->GetPointer(3 * i));
  }
  offsets->SetValue(triangles, static_cast<vtkTypeInt32>(3 * triangles));
  vtkNew<vtkPoints> points;
  points->SetData(positions);
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, indices);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->SetScalars(colors);
  return data;
}

vtkSmartPointer<vtkRenderer> to_renderer(const FigureLayer& layer, int number, const FigureView& view,
                                         const Rgb& background) {
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetLayer(number);
  renderer->SetBackground(background[0] / 255.0, background[1] / 255.0, background[2] / 255.0);
  renderer->GetCullers()->RemoveAllItems();
  const Eigen::Vector3d position = view.T_world_view.translation() - layer.mesh.origin();
  const Eigen::Matrix3d R = view.T_world_view.rotation_matrix();
  const Eigen::Vector3d target = position + R.col(2);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(position.x(), position.y(), position.z());
  camera->SetFocalPoint(target.x(), target.y(), target.z());
  camera->SetViewUp(-R(0, 1), -R(1, 1), -R(2, 1));
  camera->SetUseExplicitProjectionTransformMatrix(true);
  if (layer.mesh.empty()) return renderer;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(to_poly_data(layer.mesh));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetBackfaceCulling(layer.cull_back ? 1 : 0);
  renderer->AddActor(actor);
  return renderer;
}

/// Collects VTK's messages about the window, which VTK would otherwise print. Debian's GLEW, which looks for GLX,
/// reports that it could not be initialised although it has found all functions: that message is ignored. Of the others
/// the first is kept.
void keep_fault(vtkObject*, unsigned long, void* fault, void* message) {
  const std::string text = message != nullptr ? static_cast<const char*>(message) : "";
  auto& kept = *static_cast<std::string*>(fault);
  if (text.find("GLEW could not be initialized") == std::string::npos && kept.empty()) kept = text;
}

/// Means over blocks of samples x samples; VTK's rows are ordered from the bottom.
void shrink_into(const unsigned char* rgb, cv::Size tile, cv::Mat3b& picture, cv::Point corner) {
  const cv::Size part(std::min(tile.width / samples, picture.cols - corner.x),
                      std::min(tile.height / samples, picture.rows - corner.y));
  for (int y = 0; y < part.height; ++y) {
    cv::Vec3b* out = picture.ptr<cv::Vec3b>(corner.y + y) + corner.x;
    for (int x = 0; x < part.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int j = 0; j < samples; ++j) {
          const std::ptrdiff_t row = tile.height - 1 - (y * samples + j);
          for (int i = 0; i < samples; ++i) sum += rgb[3 * (row * tile.width + std::ptrdiff_t{x} * samples + i) + c];
        }
        out[x][c] = static_cast<unsigned char>((sum + samples * samples / 2) / (samples * samples));
      }
    }
  }
}

}  // namespace

struct OffscreenWindow::Parts {
  EglContext context;
  std::string fault;
  vtkNew<vtkGenericOpenGLRenderWindow> window;
};

OffscreenWindow::OffscreenWindow() : parts_(std::make_unique<Parts>()) {
  vtkGenericOpenGLRenderWindow* window = parts_->window;
  window->SetIsCurrent(true);
  window->SetReadyForRendering(true);
  window->SetSupportsOpenGL(true);
  window->SetOwnContext(0);
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetFrameBlitModeToNoBlit();
  vtkNew<vtkCallbackCommand> on_error;
  on_error->SetClientData(&parts_->fault);
  on_error->SetCallback(keep_fault);
  window->AddObserver(vtkCommand::ErrorEvent, on_error);
  vtkNew<vtkCallbackCommand> make_current;
  make_current->SetClientData(&parts_->context);
  make_current->SetCallback(
      [](vtkObject*, unsigned long, void* context, void*) { static_cast<EglContext*>(context)->make_current(); });
  window->AddObserver(vtkCommand::WindowMakeCurrentEvent, make_current);
  window->OpenGLInitContext();
}

OffscreenWindow::~OffscreenWindow() { parts_->window->Finalize(); }

cv::Mat3b OffscreenWindow::render(const std::vector<FigureLayer>& layers, const FigureView& view,
                                  const Rgb& background) {
  vtkGenericOpenGLRenderWindow* window = parts_->window;
  parts_->context.make_current();
  cv::Mat3b picture(view.size, background);
  const cv::Size whole(samples * view.size.width, samples * view.size.height);
  const cv::Size tile(std::min(whole.width, largest_tile), std::min(whole.height, largest_tile));
  window->SetSize(tile.width, tile.height);
  window->SetNumberOfLayers(std::max(1, static_cast<int>(layers.size())));
  std::vector<vtkSmartPointer<vtkRenderer>> renderers;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    renderers.push_back(to_renderer(layers[i], static_cast<int>(i), view, background));
    window->AddRenderer(renderers.back());
  }
  const DepthRange range = depth_range(layers, view);
  vtkNew<vtkUnsignedCharArray> pixels;
  for (int y = 0; y < whole.height && !layers.empty(); y += tile.height) {
    for (int x = 0; x < whole.width; x += tile.width) {
      for (auto& renderer : renderers) {
        renderer->GetActiveCamera()->SetExplicitProjectionTransformMatrix(projection(view, {x, y}, tile, range));
      }
      window->Render();
      if (!parts_->fault.empty()) throw std::runtime_error("VTK: " + parts_->fault);
      window->GetPixelData(0, 0, tile.width - 1, tile.height - 1, 0, pixels, 0);
      if (pixels->GetNumberOfValues() != static_cast<vtkIdType>(3) * tile.width * tile.height) {
        throw std::runtime_error("OpenGL gave no picture (" + renderer() + ")");
      }
      shrink_into(pixels->GetPointer(0), tile, picture, {x / samples, y / samples});
    }
  }
  for (auto& renderer : renderers) {
    renderer->ReleaseGraphicsResources(window);
    window->RemoveRenderer(renderer);
  }
  return picture;
}

std::string OffscreenWindow::renderer() const {
  const std::string capabilities = parts_->window->ReportCapabilities();
  const std::string key = "renderer string:";
  const std::size_t at = capabilities.find(key);
  std::string name = "unknown renderer";
  if (at != std::string::npos) {
    const std::size_t begin = capabilities.find_first_not_of(' ', at + key.size());
    name = capabilities.substr(begin, capabilities.find('\n', begin) - begin);
  }
  return parts_->context.platform() + ", " + name;
}

}  // namespace odosplat
