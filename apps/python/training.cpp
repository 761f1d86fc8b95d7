// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <functional>
#include <optional>

#include "apps/cli/train/train.hpp"
#include "apps/cli/train/train_views.hpp"
#include "apps/input/cloud_files.hpp"
#include "apps/python/arrays.hpp"
#include "apps/python/bindings.hpp"
#include "apps/python/cameras.hpp"
#include "apps/python/maps.hpp"
#include "apps/python/sequences.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/splat/map_training.hpp"

namespace odosplat::python {
namespace {

/// Called with step, steps, PSNR [dB] (0: not known yet) and the number of Gaussians.
using ProgressCall = std::function<void(int, int, double, std::size_t)>;

/// Images in memory with their poses.
class ImageViews : public TrainingViews {
 public:
  ImageViews(ImageInput input, const py::list& images, const py::object& poses, const py::object& depths)
      : input_(std::move(input)), poses_(poses_from(poses, "poses")) {
    const cv::Size size(input_.camera().width, input_.camera().height);
    for (std::size_t i = 0; i < images.size(); ++i) {
      images_.push_back(input_.take(images[i], "images[" + std::to_string(i) + "]"));
      if (images_.back().is_gray()) throw InputError("images[" + std::to_string(i) + "]", "must have colours");
    }
    if (images_.empty()) throw InputError("images", "there are none");
    if (images_.size() != poses_.size()) {
      throw InputError("poses", "must be as many as images: " + std::to_string(images_.size()) + ", are " +
                                    std::to_string(poses_.size()));
    }
    if (depths.is_none()) return;
    for (const py::handle& item : depths) {
      const std::string name = "depths[" + std::to_string(depths_.size()) + "]";
      depths_.push_back(item.is_none() ? DepthImage() : input_.depth(depth_from(item, size, name)));
    }
    if (depths_.size() != images_.size()) throw InputError("depths", "must be as many as images");
  }

  int count() const override { return static_cast<int>(images_.size()); }
  Camera camera(int) const override { return input_.camera(); }
  SE3 T_world_camera(int i) const override { return poses_[static_cast<std::size_t>(i)]; }
  ColorImage color(int i) override { return input_.color(images_[static_cast<std::size_t>(i)]); }
  DepthImage depth(int i) override { return depths_.empty() ? DepthImage() : depths_[static_cast<std::size_t>(i)]; }

 private:
  ImageInput input_;
  std::vector<RawImage> images_;
  std::vector<SE3> poses_;
  std::vector<DepthImage> depths_;
};

/// Passes views on and lets Ctrl-C end the work whenever an image is asked for.
class InterruptibleViews : public TrainingViews {
 public:
  explicit InterruptibleViews(TrainingViews& views) : views_(views) {}
  int count() const override { return views_.count(); }
  Camera camera(int i) const override { return views_.camera(i); }
  SE3 T_world_camera(int i) const override { return views_.T_world_camera(i); }
  ColorImage color(int i) override {
    throw_if_signalled();
    return views_.color(i);
  }
  DepthImage depth(int i) override { return views_.depth(i); }

 private:
  TrainingViews& views_;
};

/// The settings of Python's train functions, all but sequences and cloud.
apps::TrainJob job_from(const py::dict& settings, const std::vector<std::string>& options) {
  apps::TrainJob job;
  const auto take = [&](const char* name, auto& target) {
    using Value = std::remove_reference_t<decltype(target)>;
    try {
      if (const py::object value = settings[name]; !value.is_none()) target = value.cast<Value>();
    } catch (const py::cast_error&) {
      throw InputError(name, "is of the wrong type or out of range");
    }
  };
  take("every", job.every);
  take("preset", job.preset);
  take("iterations", job.iterations);
  take("seed", job.seed);
  take("budget", job.budget);
  take("densify", job.densify);
  take("depth_weight", job.depth_weight);
  take("sh_degree", job.sh_degree);
  take("blend_order", job.blend_order);
  take("voxel", job.voxel);
  take("remove_outliers", job.remove_outliers);
  if (const py::object exposure = settings["exposure"]; !exposure.is_none()) {
    if (!py::isinstance<py::bool_>(exposure)) throw InputError("exposure", "must be True, False or None");
    job.exposure = exposure.cast<bool>() ? "on" : "off";
  }
  require(job.every >= 1, "every", "at least 1, is " + std::to_string(job.every));
  require(!job.iterations || *job.iterations >= 0, "iterations", "at least 0");
  if (const apps::FrameRange range = frames_from(settings["frames"]); !settings["frames"].is_none()) {
    job.frames = std::to_string(range.begin) + ":" + std::to_string(range.end);
  }
  job.options = options_from(options, {"train"});
  return job;
}

/// A file's name, or arrays.
struct CloudInput {
  std::string file;
  PointCloud cloud;
};

CloudInput cloud_input(const py::object& value, const apps::TrainJob& job) {
  if (py::isinstance<py::bytes>(value)) return {value.cast<std::string>(), {}};
  require(job.voxel == 0.0, "voxel", "0 for a cloud in arrays: it thins the points of a file");
  CloudInput input{"cloud", cloud_from(value, "cloud")};
  return input;
}

PointCloud take_cloud(CloudInput& input, const apps::TrainJob& job) {
  if (input.cloud.size() == 0) return apps::read_cloud(input.file, job.voxel, job.remove_outliers);
  return job.remove_outliers ? apps::without_outliers(input.cloud) : std::move(input.cloud);
}

/// As run_training in apps/cli/train, without files. facts: of the trained views.
Map trained(const apps::TrainJob& job, CloudInput& cloud, TrainingViews& given, const std::string& device,
            const ProgressCall& progress, const std::function<TrainingFacts()>& facts) {
  const InitializeOptions initial = apps::initialize_options(job);
  initial.check();
  const TrainerOptions options = apps::trainer_options(job, given.count());
  options.check();
  InterruptibleViews views(given);
  const auto stage = [](const std::string&) { throw_if_signalled(); };
  const TrainingStart start = prepare_training(take_cloud(cloud, job), cloud.file, initial, views, stage);
  if (start.doubt) {
    log_warning("the images disagree on the colours of the cloud's points: likely cause: " +
                start.doubt->hypothesis.words());
  }
  const compute::Context context = open_device(device);
  Trainer trainer(context, options, start.gaussians, views, start.surface.get());
  while (!trainer.done()) {
    const TrainingStep step = trainer.step();
    throw_if_signalled();
    if (!progress) continue;
    const TrainingReport report = trainer.report();
    const py::gil_scoped_acquire lock;
    progress(step.iteration, options.iterations, report.psnr_db, report.gaussians);
  }
  return finish_training(context, trainer, start, views, facts(), stage).map;
}

std::shared_ptr<HeldMap> train(const py::list& sequences, const py::object& cloud, const py::dict& settings,
                               const std::vector<std::string>& options, const std::string& device,
                               const ProgressCall& progress) {
  const apps::TrainJob job = job_from(settings, options);
  CloudInput input = cloud_input(cloud, job);
  std::vector<Sequence> opened = sequences_from(sequences, "sequences");
  const py::gil_scoped_release unlocked;
  apps::SequenceViews views(std::move(opened), job.every,
                            job.frames.empty() ? apps::FrameRange() : apps::parse_frames(job.frames));
  return std::make_shared<HeldMap>(
      trained(job, input, views, device, progress, [&] { return apps::facts_of(job, views); }));
}

std::shared_ptr<HeldMap> train_on_images(const py::list& images, const py::object& poses, const py::object& camera,
                                         const std::string& order, const py::object& depths, const py::object& cloud,
                                         const py::dict& settings, const std::vector<std::string>& options,
                                         const std::string& device, const ProgressCall& progress) {
  const apps::TrainJob job = job_from(settings, options);
  CloudInput input = cloud_input(cloud, job);
  ImageViews views(ImageInput(camera_from(camera), color_order(order)), images, poses, depths);
  const py::gil_scoped_release unlocked;
  return std::make_shared<HeldMap>(trained(job, input, views, device, progress, [&] {
    TrainingFacts facts;
    facts.usual_iterations = TrainerOptions::preset(job.preset, views.count()).iterations;
    facts.budget = job.budget;
    for (const auto& [name, value] : job.options.items()) facts.notes.push_back("option " + name + " " + value);
    return facts;
  }));
}

}  // namespace

void bind_training(py::module_& m) {
  m.def("train", &train);
  m.def("train_on_images", &train_on_images);
}

}  // namespace odosplat::python
