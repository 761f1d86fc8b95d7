# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""odosplat: the pose of one moving camera inside a map of 3D Gaussians.

Conventions, everywhere:

- A pose is ``T_world_camera``, a [4 x 4] float64 array: ``p_world = T_world_camera @ p_camera``. Where a pose is taken,
  seven numbers ``tx ty tz qx qy qz qw`` (a row of a TUM trajectory without its time) serve as well.
- Camera: x right, y down, z forward. Metres, seconds, radians; degrees only in names that end in ``_deg``.
- Pixel (0, 0) is the centre of the top-left pixel. Depth is z along the optical axis in metres, 0 where there is none.
- Images are arrays [H x W] (grey) or [H x W x 3], uint8 (0..255) or float32 (0..1), of the camera's size. Colours are R, G, B;
  for images of OpenCV say ``color_order="bgr"``.
- A covariance is [6 x 6], of ``xi = (translation, rotation)`` [m, rad] in ``T_true = exp(xi) @ T_world_camera``: errors in
  the world's axes, about the world's origin.

Bad input is an ``InputError`` (a ``ValueError``) of one line. Long calls release the interpreter's lock; Ctrl-C ends ``train``,
``build_cloud``, ``check`` and ``calibrate`` within a step.
"""

from ._camera import Camera, DepthCamera
from ._checking import Calibration, calibrate, check
from ._cloud import Cloud, build_cloud, read_cloud, write_cloud
from ._core import DeviceError, InputError, NoResult
from ._core import version as __version__
from ._device import Device, devices, set_log_level, set_threads, threads
from ._evaluation import Evaluation, Statistics, evaluate
from ._map import Map, Rendering
from ._options import Option, options
from ._relocalizer import Location, Relocalizer
from ._sequence import Sequence
from ._tracker import Pose, Tracker, TrackStatistics
from ._training import train, train_on_images
from ._trajectory import Trajectory, read_trajectory, write_trajectory

__all__ = [
    "Calibration",
    "Camera",
    "Cloud",
    "DepthCamera",
    "Device",
    "DeviceError",
    "Evaluation",
    "InputError",
    "Location",
    "Map",
    "NoResult",
    "Option",
    "Pose",
    "Relocalizer",
    "Rendering",
    "Sequence",
    "Statistics",
    "TrackStatistics",
    "Tracker",
    "Trajectory",
    "__version__",
    "build_cloud",
    "calibrate",
    "check",
    "devices",
    "evaluate",
    "options",
    "read_cloud",
    "read_trajectory",
    "set_log_level",
    "set_threads",
    "threads",
    "train",
    "train_on_images",
    "write_cloud",
    "write_trajectory",
]
