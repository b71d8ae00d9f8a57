// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/log/transformed/changed_source.hpp"

namespace faultline {

/// Converts logged torques to those that act on the joints. The torque of joint j at time t is the logged one
/// at t - delay_s[j], since torques act later (or earlier) than they are logged; it is interpolated linearly
/// between samples and held constant before the first and after the last one. It is then multiplied by
/// gain[j], and cut to limit[j] where that is not 0. All other channels pass unchanged.
class TorqueConversion {
 public:
  TorqueConversion(std::vector<double> delay_s, std::vector<double> gain = {},
                   std::vector<double> limit = {});

  bool next(LogSource& source, Log& segment);

 private:
  bool fill(LogSource& source);
  double torque_at(int j, double t);

  std::vector<double> delay_s_, gain_, limit_;  ///< by joint; further joints have no delay, gain 1, no limit
  double ahead_s_ = 0.0;                        ///< s, how far the latest torque needed lies after its row
  double behind_s_ = 0.0;                       ///< s, how far the earliest one lies before it
  Log rows_;                                    ///< rows not handed out yet
  bool at_end_ = false;
  std::vector<double> time_;  ///< times of the stored torques
  JointSignals tau_;
  std::vector<std::size_t> position_;  ///< by joint: first stored torque not before the last query
};

using ConvertedTorqueSource = StagedSource<TorqueConversion>;

}  // namespace faultline
