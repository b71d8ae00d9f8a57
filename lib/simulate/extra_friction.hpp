// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/robot/chain.hpp"

namespace faultline {

/// Coulomb friction that is (1 + share exp(-(v / speed)^2)) times the model's at the speed v: breakaway
/// friction exceeds sliding friction (Stribeck). One number for each joint; empty: none.
struct StickSlipSpec {
  std::vector<double> share{};
  std::vector<double> speed{};  ///< rad/s or m/s
};

/// Viscous and Coulomb friction that are (1 + share exp(-t / time_s)) times the model's t seconds into the
/// run. One number for each joint; empty: none.
struct WarmUpSpec {
  std::vector<double> share{};
  std::vector<double> time_s{};
};

/// Throws Error(usage) naming the key if a spec does not fit so many joints.
void check_stick_slip(int joints, const StickSlipSpec& spec);
void check_warm_up(int joints, const WarmUpSpec& spec);

/// Friction of a robot beyond that of its chain. The friction of a fault has stick-slip but no warm-up.
class ExtraFriction {
 public:
  /// `healthy` is the chain without faults; the specs must fit it.
  ExtraFriction(const Chain& healthy, const StickSlipSpec& stick_slip, const WarmUpSpec& warm_up);

  bool any() const { return any_; }
  /// Sets the time into the run at which torque() is evaluated.
  void set_time(double t);
  /// Returns the torque against the motion, N m or N, in addition to the current chain's friction `now`.
  double torque(int j, double speed, const Friction& now) const;
  /// Returns a friction at least as large and as steep as `now` plus the additional friction at any time.
  Friction worst(int j, Friction now) const;

 private:
  std::vector<double> breakaway_, breakaway_speed_, cold_, warm_up_s_;
  std::vector<Friction> healthy_;
  std::vector<double> still_cold_;  ///< current share above the model's friction
  bool any_ = false;
};

}  // namespace faultline
