// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/issue.hpp"
#include "lib/identify/motion/raw_stretch.hpp"

namespace faultline {

/// Counts how often each joint's torque stands at its largest and smallest value.
class TorqueLimits {
 public:
  void add(const RawStretch& stretch);
  /// Joints whose torque never changes, and those that stand at a limit for a good part of the log: what was
  /// asked for beyond it is not what moved the robot.
  Issues issues() const;

 private:
  struct Extreme {
    double value = 0.0;
    long rows = 0;
    void see(double v);
  };
  std::vector<Extreme> high_, low_;
  long rows_ = 0;
};

}  // namespace faultline
