// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/identify/motion/stretch.hpp"

namespace faultline {

/// Noise and range of what was measured, over all logs. Channels are q, then dq, by joint.
class Measurements {
 public:
  void add(const Stretch& stretch);

  /// Std of the noise, at least the rounding of the channel's digits.
  Eigen::VectorXd noise() const { return std().cwiseMax(floor()); }
  /// Least noise a channel can have: rounding of its digits.
  Eigen::VectorXd floor() const;
  bool has_dq() const { return has_dq_; }
  /// Range of every joint's position.
  Eigen::VectorXd q_low() const { return low_.head(first_.size()); }
  Eigen::VectorXd q_high() const { return high_.head(first_.size()); }
  /// Whether a joint hardly changed against its noise in all logs, or only jitters: neighbours differ as much
  /// as any two samples (von Neumann 1941).
  bool still(int joint) const;

 private:
  Eigen::VectorXd std() const;
  void add_steps(const Stretch& stretch);

  bool has_dq_ = false;
  Eigen::VectorXd square_sum_, count_, low_, high_;
  // Of q by joint, from its first value.
  Eigen::VectorXd first_, samples_, mean_, square_, steps_, step_square_;
};

}  // namespace faultline
