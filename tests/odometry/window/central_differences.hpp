// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <functional>

namespace odosplat::test {

/// d f / d x at 0 by central differences; f returns a vector, step[i] is the step of x[i]. Used for all derivatives in
/// these tests.
inline Eigen::MatrixXd central_differences(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f,
                                           const Eigen::VectorXd& step) {
  Eigen::MatrixXd J;
  for (Eigen::Index i = 0; i < step.size(); ++i) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(step.size());
    x[i] = step[i];
    const Eigen::VectorXd plus = f(x);
    x[i] = -step[i];
    const Eigen::VectorXd difference = (plus - f(x)) / (2.0 * step[i]);
    if (J.size() == 0) J.resize(difference.size(), step.size());
    J.col(i) = difference;
  }
  return J;
}

}  // namespace odosplat::test
