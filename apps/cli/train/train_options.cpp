// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/train/train.hpp"
#include "apps/cli/train/train_views.hpp"
#include "odosplat/splat/map_file.hpp"

namespace odosplat::apps {

TrainerOptions trainer_options(const TrainJob& job, int views) {
  TrainerOptions options = TrainerOptions::preset(job.preset, views);
  options.iterations = job.iterations.value_or(options.iterations);
  options.seed = job.seed;
  if (!job.densify.empty()) options.densify.method = densify_method(job.densify);
  if (job.budget > 0) options.densify.budget = job.budget;
  if (job.exposure == "on") options.exposure.rate = 1e-3;
  if (job.exposure == "off") options.exposure.rate = 0.0;
  options.depth.weight = job.depth_weight.value_or(options.depth.weight);
  if (is_splat_path(job.out)) options.rasterizer.order = BlendOrder::depth;
  if (!job.blend_order.empty()) options.rasterizer.order = blend_order(job.blend_order);
  job.options.apply(options);
  return options;
}

InitializeOptions initialize_options(const TrainJob& job) {
  InitializeOptions options = InitializeOptions::preset(job.preset);
  options.budget = job.budget;
  options.seed = job.seed;
  options.sh_degree = job.sh_degree.value_or(options.sh_degree);
  job.options.apply(options);
  return options;
}

TrainingFacts facts_of(const TrainJob& job, const SequenceViews& views) {
  TrainingFacts facts;
  facts.usual_iterations = TrainerOptions::preset(job.preset, views.count()).iterations;
  facts.budget = job.budget;
  for (const auto& [name, value] : job.options.items()) facts.notes.push_back("option " + name + " " + value);
  const FrameRange range = job.frames.empty() ? FrameRange() : parse_frames(job.frames);
  for (const Sequence& sequence : views.sequences())
    facts.notes.push_back(training_frames_line(sequence, job.every, range));
  return facts;
}

}  // namespace odosplat::apps
