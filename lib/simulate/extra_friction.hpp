// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/robot/chain.hpp"

namespace faultline {

/// Coulomb friction that is (1 + share exp(-(v / speed)^2)) times the model's at the speed v: a joint breaks
/// away with more than it slides with (Stribeck). One number each a joint; empty: none.
struct StickSlipSpec {
  std::vector<double> share{};
  std::vector<double> speed{};  ///< rad/s or m/s
};

/// Viscous and Coulomb friction that are (1 + share exp(-t / time_s)) times the model's t seconds into the
/// run. One number each a joint; empty: none.
struct WarmUpSpec {
  std::vector<double> share{};
  std::vector<double> time_s{};
};

/// Throws Error(usage) naming the key when a spec does not fit so many joints.
void check_stick_slip(int joints, const StickSlipSpec& spec);
void check_warm_up(int joints, const WarmUpSpec& spec);

/// The friction of a robot beyond that of its chain. What a fault adds sticks, but does not warm up.
class ExtraFriction {
 public:
  /// `healthy` is the chain without faults; the specs fit it.
  ExtraFriction(const Chain& healthy, const StickSlipSpec& stick_slip, const WarmUpSpec& warm_up);

  bool any() const { return any_; }
  /// Sets the time into the run that torque() is for.
  void set_time(double t);
  /// Against the motion, N m or N, beside the friction `now` of the moment's chain.
  double torque(int joint, double speed, const Friction& now) const;
  /// A friction at least as large and as steep as `now` with all that is beyond it, at any time.
  Friction worst(int joint, Friction now) const;

 private:
  std::vector<double> breakaway_, breakaway_speed_, cold_, warm_up_s_;
  std::vector<Friction> healthy_;
  std::vector<double> still_cold_;  ///< share above the model's friction, now
  bool any_ = false;
};

}  // namespace faultline
