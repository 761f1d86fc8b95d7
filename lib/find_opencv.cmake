# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
# odosplat_find_opencv(MODULE...): targets opencv_MODULE. From OpenCV's own package where it is installed. Debian has that
# in libopencv-dev alone, which brings every module and VTK: with the modules' packages, libraries and headers are found
# by name. odosplat_missing_opencv: the modules that were not found.
macro(odosplat_find_opencv)
  set(odosplat_missing_opencv "")
  find_package(OpenCV QUIET COMPONENTS ${ARGN})
  if(NOT OpenCV_FOUND)
    find_path(ODOSPLAT_OPENCV_HEADERS opencv2/core.hpp PATH_SUFFIXES opencv4 DOC "OpenCV's include folder")
    foreach(odosplat_module ${ARGN})
      find_library(ODOSPLAT_OPENCV_${odosplat_module} opencv_${odosplat_module} DOC "OpenCV's ${odosplat_module}")
      if(NOT ODOSPLAT_OPENCV_HEADERS OR NOT ODOSPLAT_OPENCV_${odosplat_module})
        list(APPEND odosplat_missing_opencv ${odosplat_module})
      elseif(NOT TARGET opencv_${odosplat_module})
        add_library(opencv_${odosplat_module} UNKNOWN IMPORTED)
        set_target_properties(opencv_${odosplat_module} PROPERTIES
          IMPORTED_LOCATION ${ODOSPLAT_OPENCV_${odosplat_module}}
          INTERFACE_INCLUDE_DIRECTORIES ${ODOSPLAT_OPENCV_HEADERS})
      endif()
    endforeach()
  endif()
endmacro()
