// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/identify/motion/stretch.hpp"
#include "lib/identify/parameter_space.hpp"

namespace faultline {

/// A Gaussian prior of one parameter.
struct ParameterPrior {
  int parameter = 0;
  double value = 0.0;
  double std = 0.0;
};

struct ShootingFit {
  bool converged = false;
  std::string reason;
  Eigen::VectorXd parameters;   ///< all of the space
  Eigen::MatrixXd covariance;   ///< of all; zero rows for those not free
  Eigen::VectorXd noise;        ///< std of the residual at q (first) and dq, by joint
  Eigen::VectorXd correlation;  ///< of neighbouring residuals of q and dq by joint: 0 for noise, towards 1
                                ///< for model error
};

/// Problem to be fitted, and how long. The space and the excerpts are borrowed.
struct ShootingProblem {
  const ParameterSpace& space;
  std::span<const Excerpt> excerpts;
  Eigen::VectorXd start;  ///< all parameters of the space
  std::vector<int> free;  ///< free parameters; the others stay at `start`
  std::vector<ParameterPrior> priors;
  Eigen::VectorXd noise;   ///< first guess of the std of q (first) and dq, by joint
  Eigen::VectorXd floor;   ///< least values of `noise`: rounding
  int max_iterations = 0;  ///< of each solve
  int max_rounds = 0;      ///< solves, each with noise and outlier weights measured anew
  int threads = 1;

  Eigen::VectorXd first_noise() const { return noise.cwiseMax(floor); }
};

/// Estimates by output error (multiple shooting) the parameters and the start of every excerpt that bring the
/// integrated motion nearest to the measured one, each channel weighted by its own residual (iterated),
/// samples beyond four standard deviations weighted down. Ceres, Schur complement over the starts.
ShootingFit fit_shooting(const ShootingProblem& problem, const Progress& progress);

}  // namespace faultline
