// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lib/identify/parameter_space.hpp"
#include "lib/identify/stretch.hpp"

namespace faultline {

/// One window: the momentum balance of every joint, weighted over the window so that no acceleration is
/// needed,
///   sum w (p_k+1 - p_k) = sum w dt (tau - F + dT/dq - G),   sum w dt = 1.
/// Row j reads base * beta + viscous fv_j + coulomb fc_j + offset_j - timing phi = torque.
struct WeakWindow {
  int log = 0;
  double time_s = 0.0;  ///< its start
  int rows = 0;
  Eigen::MatrixXd base;  ///< joints x base parameters
  Eigen::VectorXd viscous, coulomb, timing, torque;
  double travel = 0.0;  ///< how much the joints move in it, rad or m, summed
};

/// Windows of all logs, bounded in number: when there are too many, every other one goes and from then on
/// only every other one comes.
class WeakWindows {
 public:
  WeakWindows(const ParameterSpace& space, double window_s, int max_windows);

  /// Windows of a stretch, each half over the last. Those with an outlier in them are left out.
  void add(const Stretch& stretch);

  const ParameterSpace& space() const { return space_; }
  const std::vector<WeakWindow>& all() const { return windows_; }
  std::int64_t rows_used(int log) const;

 private:
  void keep(WeakWindow window);

  ParameterSpace space_;
  double window_s_;
  std::size_t max_windows_;
  std::int64_t seen_ = 0, stride_ = 1;
  std::vector<WeakWindow> windows_;
  std::vector<std::int64_t> rows_;
};

/// Solution of the windows' equations for the linear parameters of the space.
struct WeakFit {
  Eigen::VectorXd parameters;     ///< all of the space; widths as they were
  Eigen::MatrixXd covariance;     ///< of all; zero rows where kept. Sandwich over blocks of about a second
  std::vector<bool> free;         ///< false: kept at its given value
  std::vector<bool> confounded;   ///< true: kept, or its column nearly a mixture of others
  double condition_number = 0.0;  ///< of the base columns scaled to length 1
  std::vector<double> residual_rms, r2;  ///< by joint, N m or N, over all windows
  int windows = 0;
};

/// Weighted least squares (each joint by its own residual), bisquare weights against outliers.
/// `start` gives the values of parameters that `wanted` leaves out or the data cannot tell.
WeakFit fit_weak_form(const WeakWindows& windows, const Eigen::VectorXd& start,
                      const std::vector<bool>& wanted);

/// Torque the parameters leave unexplained in every window: windows x joints.
Eigen::MatrixXd weak_residuals(const WeakWindows& windows, const Eigen::VectorXd& parameters);

}  // namespace faultline
