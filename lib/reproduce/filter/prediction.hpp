// SPDX-License-Identifier: MIT
#pragma once

#include "lib/reproduce/filter/fault_dynamics.hpp"
#include "lib/reproduce/filter/gaussian_state.hpp"

namespace faultline {

/// From one sample to the next; lists have an entry a joint.
struct Step {
  double dt = 0.0;                              ///< s
  std::span<const double> torque{};             ///< logged at its start, N m or N
  std::span<const double> next_torque{};        ///< logged at its end
  std::span<const double> drive_level{};        ///< at its start, without what answers the sensors' noise
  std::span<const bool> pressed{};              ///< at its end: joints that an end stop may hold; or empty
  std::span<const bool> torque_missing{};       ///< at its start: held over because none was logged; or empty
  std::span<const bool> next_torque_missing{};  ///< at its end
};

/// The Kalman prediction of q, dq (and fault sizes) over a step, healthy when `hypothesis` is null. `age_s`
/// is the time since the onset at the start of the step.
void predict(GaussianState& state, const MotionModel& model, const FaultDynamics& dynamics, const Step& step,
             const Hypothesis* hypothesis, double age_s);

/// The same for the step within which the fault begins. The share f of the step that it is there is uniform
/// in 0..1, so that its effect f (d + B e), d at the mean size and B e from the size's own doubt e, has the
/// mean d/2 and the covariance d d^T / 12 + B P B^T / 3.
void predict_onset(GaussianState& state, const MotionModel& model, const FaultDynamics& dynamics,
                   const Step& step, const Hypothesis& hypothesis);

/// The healthy state with the sizes of `hypothesis` added at their priors.
GaussianState with_sizes(const GaussianState& healthy, const Hypothesis& hypothesis,
                         const SizePriors& priors);

/// Keeps sizes in the range that has a meaning: a share of torque, added friction, a tip that keeps some
/// mass.
void clamp_sizes(GaussianState& state, const Hypothesis& hypothesis, const MotionModel& model);

}  // namespace faultline
