// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/identify/motion/stretch.hpp"

namespace faultline {

/// Noise and range of the measurements, over all logs. Channels are q, then dq, by joint.
class Measurements {
 public:
  void add(const Stretch& stretch);

  /// Returns the std of the noise, at least the rounding of the channel's digits.
  Eigen::VectorXd noise() const { return std().cwiseMax(floor()); }
  /// Returns the least possible noise of each channel: rounding of its digits.
  Eigen::VectorXd floor() const;
  bool has_dq() const { return has_dq_; }
  /// Lowest and highest position of every joint.
  Eigen::VectorXd q_low() const { return low_.head(first_.size()); }
  Eigen::VectorXd q_high() const { return high_.head(first_.size()); }
  /// Whether the range of a joint is within 20 times its noise in all logs, or the joint only jitters: the
  /// mean squared step between neighbours exceeds the variance (von Neumann 1941).
  bool still(int joint) const;

 private:
  Eigen::VectorXd std() const;
  void add_steps(const Stretch& stretch);

  bool has_dq_ = false;
  Eigen::VectorXd square_sum_, count_, low_, high_;
  // Sums over q by joint, less its first value.
  Eigen::VectorXd first_, samples_, mean_, square_, steps_, step_square_;
};

}  // namespace faultline
