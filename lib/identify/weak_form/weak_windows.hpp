// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/identify/motion/stretch.hpp"
#include "lib/identify/parameter_space.hpp"

namespace faultline {

/// Friction widths of the weak form: multiples of the robot's, from sharp to smooth. The widest serve bent
/// friction alone.
inline constexpr int kWidths = 12;
inline constexpr int kCoulombWidths = 9;  ///< of Coulomb friction: the first, up to 10 times the robot's own
inline constexpr int kOwnWidth = 4;       ///< the robot's own
double weak_width(const ParameterSpace& space, int j, int k);

/// Setting for the columns of extra terms: properties of the robot that are known before they are fitted.
struct ExtraSetting {
  std::vector<int> shift;      ///< by joint: samples by which its torque acts later than logged; empty: 0
  double phi = 0.5;            ///< of the torque between samples
  Eigen::VectorXd parameters;  ///< of the space, whatever its extra terms; empty: those of its chain
};

/// Contribution of every sample of a stretch to the momentum balance of a window that holds it, one column a
/// sample (from row k to row k + 1), joint after joint within a group of rows.
struct StretchTerms {
  Eigen::MatrixXd base;  ///< (base parameters x joints) rows, base after base: p_k+1 - p_k - dt (dT/dq - G)
  Eigen::MatrixXd viscous;  ///< joints rows: q_k+1 - q_k
  Eigen::MatrixXd coulomb;  ///< (kWidths x joints) rows: integral of tanh(dq / width)
  Eigen::MatrixXd skew;     ///< joints rows: integral of |dq|
  Eigen::MatrixXd rotor;    ///< joints rows: momentum of rotors that are no base parameter
  Eigen::MatrixXd extra;    ///< (extra terms x joints) rows
  Eigen::VectorXd step_s;   ///< duration
};

StretchTerms stretch_terms(const ParameterSpace& space, const Stretch& stretch,
                           const ExtraSetting& setting = {});

/// Samples by which the torque may act later (positive) or earlier than it is logged: first ... last.
struct ShiftRange {
  int first = -1;
  int last = 1;

  int count() const { return last - first + 1; }
};

/// One window: the momentum balance of every joint, weighted over the window so that no acceleration is
/// needed,
///   sum w (p_k+1 - p_k) = sum w dt (tau - F + dT/dq - G),   sum w dt = 1.
/// Row j is base * beta + viscous fv_j + coulomb fc_j + offset_j + another column of coulomb fb_j + skew fs_j
/// + extra terms = torque.
struct WeakWindow {
  int log = 0;
  double time_s = 0.0;      ///< start of the window
  Eigen::MatrixXd base;     ///< joints x base parameters
  Eigen::MatrixXd coulomb;  ///< joints x kWidths, one column per friction width
  Eigen::MatrixXd extra;    ///< joints x extra terms
  Eigen::VectorXd viscous, skew;
  Eigen::MatrixXd torque;  ///< joints x shifts: the mean of tau_k-shift; less the momentum of known rotors
  Eigen::VectorXd q, dq;   ///< in the middle of the window, by joint
  Eigen::VectorXd speed;   ///< mean |dq| of each joint in the window, rad/s or m/s
};

/// Windows of one length over all logs, bounded in number: above the bound, every other one is dropped, and
/// from then on only every other one is added.
class WeakWindows {
 public:
  WeakWindows(double length_s, int max_windows)
      : length_s_(length_s), max_windows_(static_cast<std::size_t>(max_windows)) {}

  /// Adds the windows of a stretch, each overlapping half of the previous one, except those in which more
  /// than half of the positions of a joint are outliers or not measured.
  void add(const Stretch& stretch, const StretchTerms& terms, const ShiftRange& shifts);

  /// Returns an empty set of the same kind, to be filled again.
  WeakWindows emptied() const { return WeakWindows(length_s_, static_cast<int>(max_windows_)); }
  /// Keeps only those extra terms.
  void keep_extra(const std::vector<int>& terms);

  /// Drops the windows of those logs.
  void leave_out(const std::vector<bool>& logs);

  double length_s() const { return length_s_; }
  const std::vector<WeakWindow>& all() const { return windows_; }
  std::int64_t rows_used(int log) const;

 private:
  void keep(WeakWindow window);

  double length_s_;
  std::size_t max_windows_;
  std::int64_t seen_ = 0, stride_ = 1;
  std::vector<WeakWindow> windows_;
  std::vector<std::int64_t> rows_;
};

/// Windows of several lengths, short to long, of the same logs.
struct WeakSets {
  ParameterSpace space;
  ShiftRange shifts;
  std::vector<WeakWindows> sets;
  ExtraSetting extra;  ///< setting of the columns of the extra terms of `space`
  /// Joints that never move: stiction may carry any torque, so their balances do not count.
  std::vector<Joint> still;

  void add(const Stretch& stretch);
};

/// Returns the window lengths to choose from, s; on slow logs those that differ in samples.
std::vector<double> window_lengths(double shortest_s, double period_s);
/// Returns the torque shifts to try at a sample period.
ShiftRange shift_range(double period_s);

}  // namespace faultline
