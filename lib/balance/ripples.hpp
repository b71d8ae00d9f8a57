// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

namespace faultline {

/// Torques that a ripple may have: its sine and cosine alone, or these and their products with the torque.
enum class RippleForm { constant, constant_and_by_torque };

/// Form of a ripple, and what it must have to be accepted.
struct RippleBounds {
  RippleForm form = RippleForm::constant;
  double least_explained = 0.0;  ///< share of the joint's squared residual
  double least_waves = 0.0;      ///< radians of the ripple over the range of the joint
  int refinements = 0;  ///< steps of the golden section that refine the rate between those of the search
};

/// Rows of one joint that count, in SI units: position, velocity, torque and residual torque.
struct RippleRows {
  std::vector<double> q, dq, torque, left;

  void add(double position, double velocity, double whole_torque, double residual) {
    q.push_back(position);
    dq.push_back(velocity);
    torque.push_back(whole_torque);
    left.push_back(residual);
  }
};

/// Returns the rate (1/rad or 1/m) of the ripple that explains most of the residual of a joint whose range is
/// `range` (rad or m), in steps of 1 rad over that range and as refined as the bounds ask for; none if it is
/// not within the bounds or there are no rows.
std::optional<double> strongest_ripple(RippleRows rows, double kernel_s, double range,
                                       const RippleBounds& bounds);

}  // namespace faultline
