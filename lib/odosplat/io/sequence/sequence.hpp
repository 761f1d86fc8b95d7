// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/trajectory.hpp"
#include "odosplat/io/camera/camera_file.hpp"
#include "odosplat/io/sequence/sequence_options.hpp"

namespace odosplat {

/// A recorded sequence: images with times and, where the data set gives them, depth and true poses.
///
/// Layouts (path: a folder, or a video file; formats as their authors publish them):
///   tum          rgb.txt, or associations.txt whose ids are times (with a decimal point); camera.yaml; optionally
///                depth.txt and groundtruth.txt. With associations.txt a colour image has the depth image of its pair;
///                without, the one nearest in time, at most 0.02 s away as in TUM's own tool, and each depth image is
///                used for one colour image only. Pose of a colour image: the one with an equal stamp; else
///                interpolated between the two poses around it if these are at most 0.1 s apart; else the nearest
///                within 0.01 s; else none. Also none if groundtruth.txt has a pose with that stamp that is not finite.
///   icl          associations.txt (ids, depth first), *.gt.freiburg or *.gt.sim: image k has the pose with id k.
///                fx fy cx cy: 481.2 -480 319.5 239.5; depth 5000 units per metre.
///   redwood      *-color, *-depth*, *-traj.txt or *.log: image number k has pose k. fx fy cx cy: 525 525 319.5 239.5;
///                depth 1000 units per metre.
///   sevenscenes  frame-NNNNNN.{color.png|color.jpg,depth.png,pose.txt} in the folder or in its only seq-NN.
///                Two cameras as published: colour 525 525 320 240, depth 585 585 320 240 at 1000 units per metre,
///                with the motion between them. The poses are the depth camera's: if the camera file in use has a
///                depth_camera, as the published one has, they are moved to the colour camera.
///   replica      results/frameN.jpg, results/depthN.png, traj.txt; cam_params.json there or one folder above.
///   colmap       a COLMAP model (cameras, images and points3D as .bin or .txt) in the folder, in sparse or in
///                sparse/0; images in the folder images, in the folder itself, or in images one or two folders above.
///                Frames in the natural order of their names, frame k at k / fps. Camera models SIMPLE_PINHOLE,
///                PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV. All images must have one camera (common_camera), unless a
///                camera file is given. World frame and scale are the model's own: see sparse_points() and `odosplat
///                align`.
///   nerfstudio   transforms.json, or the path of a file of that format with another name: frames by `timestamp` [s] if
///                they have it, else in the natural order of their names, frame k at k / fps; one camera, given by the
///                file or by every frame (common_camera), OPENCV or simpler, unless a camera file is given; image names
///                may lack .png, .jpg or .jpeg; depth_file_path in millimetres or as depth_unit_scale_factor says. The
///                world is that of the stored poses and of ply_file_path; applied_transform is not undone. Masks are
///                not used.
///   images       PNG and JPEG files in natural order (2 before 10), with a camera file. No poses, no depth.
///   video        a video that FFmpeg decodes, with a camera file, rotated as the container says that it is to be shown
///                (phones), with the container's time stamps; frame k of a bare stream at k / fps of the camera file.
///                All frames are decoded once at opening.
/// In every layout a frame whose pose is missing or not finite has no pose, and one warning gives the number of such
/// frames. Files whose names begin with a dot are ignored. Backslashes in a listed name are treated as folder
/// separators if the file exists only under that reading.
/// A camera.yaml in the folder replaces the calibrations given above. Where only frame numbers are known, time is
/// number / fps (30 if the camera file has no fps).
///
/// Lens distortion of the camera file is removed as images are read: colour bilinear, depth nearest, same size and
/// focal lengths; pixels that the distorted image does not cover are 0. Where fy is negative (ICL-NUIM) poses are
/// reflected, T' = F T F with F = diag(1, -1, 1), so that they belong to camera(), whose fy is positive.
///
/// Depth images of another camera (depth_camera in the camera file) are registered to the colour images as they are
/// read (registered_depth).
///
/// With a time_offset in the camera file an image has the pose of its stamp plus time_offset, looked up in the list of
/// poses as in tum above; in layouts whose poses have no times of their own, in the images' poses at the images' times.
/// It has none where the list has none within these limits, and where the data set says that the image has no pose; one
/// warning gives the number of these images. Depth images have the same offset; those of a depth_camera have that of
/// depth_camera instead. All stamps stay those of the files.
///
/// Photometric calibration is applied before that (PhotometricCorrection): vignette and gamma of the camera file, and
/// exposure times of exposures.txt or DSO's times.txt in the sequence's folder, so that colours are those of a camera
/// without vignetting and with the median exposure. A camera file with a vignette but no gamma is taken to mean gamma 1
/// (stored values are proportional to radiance). Without vignette and exposures nothing changes.
///
/// Poses too far from the origin for single precision, such as those in a survey frame, are refused
/// (require_near_origin).
///
/// Images are decoded on request and not kept, and only after a check that the size in their header is the camera's.
/// Colour files that are listed but missing give one warning, and an error when they are read or if all are missing;
/// missing depth or truth is not an error. Errors: InputError naming the file. Copies share the data. Const calls are
/// thread safe.
class Sequence {
 public:
  static Sequence open(const std::string& path, const SequenceOptions& options = {});

  /// Last part of the path ("icl_office_kt3").
  const std::string& name() const;
  const std::string& layout() const;
  /// Pinhole camera of the images that color(), gray() and depth() return.
  const Camera& camera() const;
  /// Sign of fy as the camera file or the layout declares it, 1 or -1.
  int fy_sign() const;
  /// Units of the depth files per metre.
  double depth_scale() const;
  /// All that is known of the camera, including the lens distortion of the image files; fy_sign is 1 because the poses
  /// have been reflected. The path of a vignette is relative to the working directory or absolute.
  CameraFile camera_file() const;
  /// The camera file's content as declared, or the layout's camera: fy_sign and fps as declared (0: no fps), the path of a
  /// vignette absolute.
  CameraFile declared_camera() const;
  /// True if images get their poses by time: the data set lists poses with stamps. Else the times of the images may be made
  /// up (their number by the frame rate).
  bool poses_by_time() const;
  /// Number of images that would have a pose if the camera file had this time_offset [s]. Precondition: poses_by_time().
  std::size_t posed_with_offset(double time_offset) const;
  /// Frames per second: from the camera file, else 1 / (median step of time).
  double fps() const;

  std::size_t size() const;
  double time(std::size_t i) const;  // [s]
  /// The time as written in the list, else printed with 6 decimals.
  std::string time_text(std::size_t i) const;
  /// Pose of the camera when the image was taken: at its stamp plus the camera file's time_offset.
  std::optional<SE3> T_world_camera(std::size_t i) const;
  /// The same when the frame's depth image was taken: sensors that capture colour and depth alternately (TUM) have
  /// stamps up to 20 ms apart, in which points can shift by centimetres during a fast turn. At the stamp of the depth
  /// image plus the time_offset of the colour images or, with a depth_camera, plus that of depth_camera alone; if these
  /// differ, none where the image has none. Equal to T_world_camera(i) if stamp and offset are the same or there is no
  /// depth image.
  std::optional<SE3> T_world_depth(std::size_t i) const;
  /// True poses by the images' stamps, to compare estimates with, reflected like T_world_camera: listed_poses(); with a
  /// time_offset of the images the poses that the images have, at the images' stamps.
  const Trajectory& truth() const;
  /// All poses of the data set, at their own times and rate, reflected like T_world_camera.
  const Trajectory& listed_poses() const;

  /// True if the sequence's folder lists exposure times.
  bool has_exposures() const;
  /// Exposure time of the frame over the median; 1 where it is not known.
  double exposure(std::size_t i) const;

  /// True if the data set has sparse points in the world of its poses (COLMAP's points3D, ply_file_path).
  bool has_sparse_points() const;
  /// Those points, read from the file at every call. InputError if there are none, or the file is damaged.
  PointCloud sparse_points() const;

  /// Path of the frame's colour file; empty in videos.
  const std::string& color_file(std::size_t i) const;
  /// Path of its depth file; empty: none.
  const std::string& depth_file(std::size_t i) const;
  /// Stamp of its depth image, which may differ from the colour image's (TUM).
  std::string depth_time_text(std::size_t i) const;

  /// RGB, 0..1. InputError if the file is damaged or of another size than the camera.
  ColorImage color(std::size_t i) const;
  /// Luma of color(i).
  GrayImage gray(std::size_t i) const;
  /// True if frame i has a depth image; false for all frames if none of the listed depth files exists.
  bool has_depth(std::size_t i) const;
  /// z [m], 0 = no depth; the values 0 and 65535 of a file mean no depth. Registered to the colour images if the camera
  /// file has a depth_camera. InputError if !has_depth(i), if the file is missing or damaged, or if its size is not the
  /// colour image's (the depth camera's).
  DepthImage depth(std::size_t i) const;

 private:
  struct Data;
  explicit Sequence(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

  std::shared_ptr<const Data> data_;
};

}  // namespace odosplat
