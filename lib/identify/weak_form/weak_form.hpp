// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lib/identify/parameter_space.hpp"
#include "lib/identify/stretch.hpp"

namespace faultline {

/// Friction widths that the weak form can choose from: multiples of the robot's, from sharp to smooth.
inline constexpr int kWidths = 7;
inline constexpr int kNominalWidth = 4;
double weak_width(const ParameterSpace& space, int joint, int k);

/// One window: the momentum balance of every joint, weighted over the window so that no acceleration is
/// needed,
///   sum w (p_k+1 - p_k) = sum w dt (tau - F + dT/dq - G),   sum w dt = 1.
/// Row j reads base * beta + viscous fv_j + coulomb fc_j + offset_j - timing phi = torque.
struct WeakWindow {
  int log = 0;
  double time_s = 0.0;  ///< its start
  int rows = 0;
  Eigen::MatrixXd base;     ///< joints x base parameters
  Eigen::MatrixXd coulomb;  ///< joints x kWidths, one column a friction width
  Eigen::VectorXd viscous, timing, torque;
  Eigen::VectorXd speed;  ///< mean |dq| of each joint in it, rad/s or m/s
  double travel = 0.0;    ///< how much the joints move in it, rad or m, summed
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
  Eigen::VectorXd parameters;     ///< all of the space
  Eigen::MatrixXd covariance;     ///< of all; zero rows where kept. Sandwich over blocks of about a second
  std::vector<bool> free;         ///< false: kept at its given value
  std::vector<bool> confounded;   ///< true: kept, or its column nearly a mixture of others
  double condition_number = 0.0;  ///< of the base columns scaled to length 1
  std::vector<double> residual_rms, r2;  ///< by joint, N m or N, over all windows
  int windows = 0;
};

/// Weighted least squares (each joint by its own residual), outliers weighted down.
/// `start` gives the values of parameters that `wanted` leaves out or the data cannot tell.
WeakFit fit_weak_form(const WeakWindows& windows, const Eigen::VectorXd& start,
                      const std::vector<bool>& wanted);

/// The same with Coulomb friction as sharp as the windows know it, each joint smoother only where that
/// explains clearly more torque: integrated over a window, friction needs no smoothing, and any shifts fv and
/// fc. Windows in which a joint rests say nothing of that joint: its friction may be anything up to stiction.
WeakFit fit_weak_form_and_width(const WeakWindows& windows, const Eigen::VectorXd& start,
                                const std::vector<bool>& wanted);

}  // namespace faultline
