// SPDX-License-Identifier: MIT
#include "lib/simulate/extra_friction.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/simulate/joint_list.hpp"

namespace faultline {
namespace {

/// Throws Error(usage) if a joint with a positive `share` has no positive number in `beside`.
void check_beside(int joints, const std::vector<double>& share, const std::vector<double>& beside,
                  const char* key, const char* what) {
  check_not_negative(joints, beside, key);
  for (std::size_t j = 0; j < share.size(); ++j)
    if (share[j] > 0.0 && (beside.empty() || !(beside[j] > 0.0)))
      bad_value(key, fmt::format("expected {} above 0 for joint {}, which has a share", what,
                                 Joint::at(static_cast<int>(j))));
}

}  // namespace

void check_stick_slip(int joints, const StickSlipSpec& spec) {
  check_not_negative(joints, spec.share, "stick_slip.share");
  check_beside(joints, spec.share, spec.speed, "stick_slip.speed", "a speed");
}

void check_warm_up(int joints, const WarmUpSpec& spec) {
  check_not_negative(joints, spec.share, "warm_up.share");
  check_beside(joints, spec.share, spec.time_s, "warm_up.time_s", "a time");
}

ExtraFriction::ExtraFriction(const Chain& healthy, const StickSlipSpec& stick_slip, const WarmUpSpec& warm_up)
    : breakaway_(or_all(stick_slip.share, healthy.joints(), 0.0)),
      breakaway_speed_(or_all(stick_slip.speed, healthy.joints(), 1.0)),
      cold_(or_all(warm_up.share, healthy.joints(), 0.0)),
      warm_up_s_(or_all(warm_up.time_s, healthy.joints(), 1.0)),
      healthy_(healthy.friction),
      still_cold_(cold_) {
  for (int j = 0; j < healthy.joints(); ++j) any_ = any_ || breakaway_[j] > 0.0 || cold_[j] > 0.0;
}

void ExtraFriction::set_time(double t) {
  for (std::size_t j = 0; j < cold_.size(); ++j)
    if (cold_[j] > 0.0) still_cold_[j] = cold_[j] * elementary::exp(-t / warm_up_s_[j]);
}

double ExtraFriction::torque(int j, double speed, const Friction& now) const {
  const double cold_coulomb = still_cold_[j] * healthy_[j].coulomb;
  double coulomb = cold_coulomb;
  if (breakaway_[j] > 0.0) {
    const double x = speed / breakaway_speed_[j];
    coulomb += breakaway_[j] * elementary::exp(-x * x) * (now.coulomb + cold_coulomb);
  }
  return still_cold_[j] * healthy_[j].viscous * speed + coulomb * elementary::tanh(speed / now.width);
}

Friction ExtraFriction::worst(int j, Friction now) const {
  now.viscous += cold_[j] * healthy_[j].viscous;
  now.coulomb += cold_[j] * healthy_[j].coulomb;
  if (breakaway_[j] > 0.0) {  // 0.858 is the largest slope of exp(-x^2)
    now.viscous += 0.858 * breakaway_[j] * now.coulomb / breakaway_speed_[j];
    now.coulomb *= 1.0 + breakaway_[j];
  }
  return now;
}

}  // namespace faultline
