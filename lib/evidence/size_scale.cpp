// SPDX-License-Identifier: MIT
#include "lib/evidence/size_scale.hpp"

namespace faultline {
namespace {

constexpr double kUsualPush_s = 0.05;  // how long a collision pushes; its largest torque makes the impulse
/// A model keeps the prior of the payload only, which is half the mass carried.
constexpr double kCarriedInPriors = 2.0;

}  // namespace

double prior_scale(const SizePriors& priors, SizeMeasure measure, int j) {
  switch (measure) {
    case SizeMeasure::torque_share:
      return 1.0;
    case SizeMeasure::length:
      return priors.bias[j];
    case SizeMeasure::length_per_s:
      return priors.drift[j];
    case SizeMeasure::viscous_friction:
      return priors.viscous_increase[j];
    case SizeMeasure::coulomb_friction:
      return priors.coulomb_increase[j];
    case SizeMeasure::mass:
      return priors.payload;
    case SizeMeasure::torque:
    case SizeMeasure::impulse:
      return priors.external_torque[j];
  }
  return 1.0;
}

double feature_scale(const MotionModel& model, SizeMeasure measure, int j) {
  return measure == SizeMeasure::impulse ? usual_size(model, measure, j)
                                         : prior_scale(model.priors, measure, j);
}

double usual_size(const MotionModel& model, SizeMeasure measure, int j) {
  switch (measure) {
    case SizeMeasure::torque_share:
      return 1.0;
    case SizeMeasure::length:
    case SizeMeasure::length_per_s:
      return model.q_high[j] - model.q_low[j];
    case SizeMeasure::viscous_friction:
      return model.priors.viscous_increase[j];
    case SizeMeasure::coulomb_friction:
      return model.priors.coulomb_increase[j];
    case SizeMeasure::mass:
      return kCarriedInPriors * model.priors.payload;
    case SizeMeasure::torque:
      return model.torque_scale[j];
    case SizeMeasure::impulse:
      return model.torque_scale[j] * kUsualPush_s;
  }
  return 1.0;
}

}  // namespace faultline
