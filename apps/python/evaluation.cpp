// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <pybind11/stl.h>

#include <optional>

#include "apps/command/no_result.hpp"
#include "apps/python/arrays.hpp"
#include "apps/python/bindings.hpp"
#include "apps/python/sequences.hpp"
#include "odosplat/eval/evaluate.hpp"
#include "odosplat/io/trajectory/comparable_stamps.hpp"

namespace odosplat::python {
namespace {

/// Poses to compare: of a file (its name as bytes), the true ones of a sequence, or (times, poses).
struct Judged {
  PoseFile file;
  std::string name;
};

Judged judged_from(const py::object& value, const std::string& name) {
  if (py::isinstance<py::bytes>(value)) {
    const auto path = value.cast<std::string>();
    return {read_pose_file(path), path};
  }
  if (py::isinstance<HeldSequence>(value)) {
    const Sequence& sequence = value.cast<const HeldSequence&>().sequence;
    Judged judged{{}, sequence.name()};
    judged.file.poses = sequence.truth();
    if (judged.file.poses.empty()) throw InputError(sequence.name(), "has no true poses");
    return judged;
  }
  if (!py::isinstance<py::tuple>(value) || py::len(value) != 2) {
    throw InputError(name, "must be the path of a trajectory, a Sequence (truth), or (times, poses)");
  }
  const auto parts = py::reinterpret_borrow<py::tuple>(value);
  Judged judged{{}, name};
  judged.file.poses = trajectory_from(parts[0], parts[1], name);
  return judged;
}

py::object dict_of(const Statistics& s) {
  py::dict row;
  const auto set = [&](const char* name, double value) {
    row[name] = s.count > 0 ? py::object(py::float_(value)) : py::none();
  };
  set("rmse", s.rmse);
  set("mean", s.mean);
  set("median", s.median);
  set("max", s.max);
  set("p99", s.p99);
  return row;
}

py::dict evaluated(const py::object& estimate, const py::object& truth, const std::string& align, int delta,
                   bool all_pairs, double max_time_difference) {
  EvalOptions options;
  options.alignment = alignment_from_name(align);
  options.delta = delta;
  options.all_pairs = all_pairs;
  options.max_time_difference = max_time_difference;
  options.check();
  const Judged a = judged_from(estimate, "estimate");
  const Judged b = judged_from(truth, "truth");
  require_comparable_stamps({a.file, a.name, "times"}, {b.file, b.name, "times"});
  EvalResult result;
  {
    const py::gil_scoped_release unlocked;
    try {
      result = evaluate(a.file.poses, b.file.poses, options);
    } catch (const NothingMatched& e) {
      throw apps::NoResult(e.what());
    }
  }
  py::dict row;
  row["ate_m"] = dict_of(result.ate_m);
  row["rte_m"] = dict_of(result.rte_m);
  row["rre_deg"] = dict_of(result.rre_deg);
  row["pairs"] = result.pairs;
  row["coverage"] = result.coverage;
  row["coverage_estimate"] = result.coverage_estimate;
  row["coverage_truth"] = result.coverage_truth;
  row["alignment"] = align;
  row["scale"] = result.truth_from_estimate.scale;
  row["doubt"] = result.doubt;
  row["T_truth_estimate"] = matrix_of(result.truth_from_estimate.T_target_source);
  py::array_t<double> times(static_cast<py::ssize_t>(result.matches.size()));
  py::array_t<double> errors(static_cast<py::ssize_t>(result.matches.size()));
  for (std::size_t k = 0; k < result.matches.size(); ++k) {
    times.mutable_data()[k] = a.file.poses[result.matches[k].estimate].time;
    errors.mutable_data()[k] = result.position_errors_m[k];
  }
  row["times"] = times;
  row["position_errors_m"] = errors;
  return row;
}

}  // namespace

void bind_evaluation(py::module_& m) { m.def("evaluate", &evaluated); }

}  // namespace odosplat::python
