// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/egl_context.hpp"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "odosplat/core/formatted.hpp"

namespace odosplat {
namespace {

bool has_extension(const char* list, std::string_view name) {
  const std::string_view text = list != nullptr ? list : "";
  for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || text[at - 1] == ' ') && (end == text.size() || text[end] == ' ')) return true;
  }
  return false;
}

std::string egl_error() { return formatted("0x%x", static_cast<unsigned>(eglGetError())); }

template <typename Function>
Function egl_function(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

}  // namespace

EglContext::EglContext() {
  std::string faults;
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto get_display = egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (get_display == nullptr) throw std::runtime_error("no OpenGL for figures: EGL has no eglGetPlatformDisplayEXT");

  std::vector<EGLDeviceEXT> devices(16);
  std::vector<bool> is_software(devices.size(), true);
  EGLint count = 0;
  const auto query_devices = egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto query_string = egl_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  if (query_devices != nullptr && query_string != nullptr && has_extension(client, "EGL_EXT_platform_device")) {
    query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count);
  }
  devices.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < devices.size(); ++i) {
    is_software[i] = has_extension(query_string(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software");
  }
  const auto try_devices = [&](bool software) {
    for (std::size_t i = 0; i < devices.size(); ++i) {
      if (is_software[i] == software && try_display(get_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr),
                                                    "EGL device " + std::to_string(i), faults)) {
        return true;
      }
    }
    return false;
  };
  if (try_devices(false)) return;
  if (has_extension(client, "EGL_MESA_platform_surfaceless")) {
    void* display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (try_display(display, "Mesa surfaceless", faults)) return;
  } else {
    faults += "; Mesa surfaceless: EGL does not offer it";
  }
  if (try_devices(true)) return;
  throw std::runtime_error("no OpenGL for figures (Debian: libegl-mesa0 libgl1-mesa-dri)" + faults);
}

EglContext::~EglContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroySurface(display_, surface_);
  eglDestroyContext(display_, context_);
  // The display stays initialised until the process ends: eglTerminate does not count users, and Mesa leaks a little
  // memory each time its driver is unloaded.
  eglReleaseThread();
}

bool EglContext::try_display(void* display, const std::string& platform, std::string& faults) {
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
    faults += "; " + platform + ": no display (EGL error " + egl_error() + ")";
    return false;
  }
  const std::array<EGLint, 13> wanted{EGL_SURFACE_TYPE,
                                      EGL_PBUFFER_BIT,
                                      EGL_RENDERABLE_TYPE,
                                      EGL_OPENGL_BIT,
                                      EGL_RED_SIZE,
                                      8,
                                      EGL_GREEN_SIZE,
                                      8,
                                      EGL_BLUE_SIZE,
                                      8,
                                      EGL_DEPTH_SIZE,
                                      24,
                                      EGL_NONE};
  const std::array<EGLint, 7> core{
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  // VTK draws into its own frame buffers; the surface only has to exist.
  const std::array<EGLint, 5> small{EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint found = 0;
  EGLContext context = EGL_NO_CONTEXT;
  EGLSurface surface = EGL_NO_SURFACE;
  std::string fault;
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
    fault = "no desktop OpenGL";
  } else if (eglChooseConfig(display, wanted.data(), &config, 1, &found) == EGL_FALSE || found == 0) {
    fault = "no 24-bit colour with depth";
  } else if ((context = eglCreateContext(display, config, EGL_NO_CONTEXT, core.data())) == EGL_NO_CONTEXT) {
    fault = "no OpenGL 3.2 core context";
  } else if ((surface = eglCreatePbufferSurface(display, config, small.data())) == EGL_NO_SURFACE) {
    fault = "no pbuffer";
  } else if (eglMakeCurrent(display, surface, surface, context) == EGL_FALSE) {
    fault = "context cannot be made current";
  }
  if (!fault.empty()) {
    faults += "; " + platform + ": " + fault + " (EGL error " + egl_error() + ")";
    if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    return false;
  }
  display_ = display;
  context_ = context;
  surface_ = surface;
  platform_ = platform;
  return true;
}

void EglContext::make_current() { eglMakeCurrent(display_, surface_, surface_, context_); }

}  // namespace odosplat
