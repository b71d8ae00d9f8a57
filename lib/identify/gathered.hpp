// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/core/progress.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/motion/log_survey.hpp"
#include "lib/identify/motion/stretch.hpp"
#include "lib/identify/motor_constants.hpp"
#include "lib/identify/weak_form/weak_windows.hpp"
#include "lib/log/log_source.hpp"

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
  bool still(int j) const;

 private:
  Eigen::VectorXd std() const;
  void add_steps(const Stretch& stretch);

  bool has_dq_ = false;
  Eigen::VectorXd square_sum_, count_, low_, high_;
  // Sums over q by joint, less its first value.
  Eigen::VectorXd first_, samples_, mean_, square_, steps_, step_square_;
};

/// Data that the passes over the logs gather, the properties of each log, and their issues.
struct Gathered {
  std::vector<IdentifiedLog> logs;
  Issues issues;
  std::vector<LogSurvey> surveys;
  WeakSets windows;
  Measurements measurements;
  std::vector<bool> left_out;                 ///< by log: its windows and excerpts are excluded
  std::vector<double> torque_gain;            ///< by joint: true torque per logged torque; empty: all 1
  std::optional<MotorConstants> constants{};  ///< of logged currents, beside torque_gain

  void leave_out(const std::vector<int>& more);
};

/// Reads every log twice, for the windows of `space`. A joint is still if its position hardly changed in all
/// logs: within its noise, or by less than 2 mrad or .2 mm. Throws Error(input) if the logs give too few
/// windows.
Gathered gather(std::span<LogSource* const> logs, const ParameterSpace& space, double shortest_window_s,
                int max_windows, const Progress& progress);

/// Reads every log once more and returns the windows of another space; the other fields of `gathered` stay.
Gathered gather_again(std::span<LogSource* const> logs, const ParameterSpace& space,
                      const ExtraSetting& setting, Gathered gathered);

/// Returns the data with the motor constants that they show, and the windows in torques instead of currents.
Gathered with_motor_constants(std::span<LogSource* const> logs, Gathered gathered);

/// Returns excerpts of the logs with each joint's torque shifted by the samples of its delay.
std::vector<Excerpt> gather_excerpts(std::span<LogSource* const> logs, const Gathered& gathered,
                                     const std::vector<int>& shift, Excerpts excerpts);

}  // namespace faultline
