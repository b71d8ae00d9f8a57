// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/random.hpp"
#include "lib/robot/chain.hpp"
#include "lib/simulate/fault_event.hpp"

namespace faultline {

struct NoiseSpec;

/// Turns the true motion into what the controller and the log get: noise, encoder steps and the faults of the
/// sensors, which therefore go through the feedback.
class Sensors {
 public:
  Sensors(int joints, const NoiseSpec& noise, const std::vector<SimulatedFault>& faults, Random random);

  /// Reads at time t; `q` and `dq` keep the reading until the next call (a stuck encoder repeats it).
  void read(double t, const JointVector<double>& true_q, const JointVector<double>& true_dq);

  JointVector<double> q, dq;

 private:
  std::vector<double> q_noise_, dq_noise_, resolution_;
  std::vector<SimulatedFault> faults_;
  Random random_;
  bool started_ = false;
};

}  // namespace faultline
