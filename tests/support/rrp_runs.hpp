// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/usual_motion.hpp"
#include "lib/simulate/simulate.hpp"

namespace faultline {

/// A small RRP robot with friction, all of its parameters known.
Robot known_rrp();

/// A run of it at 100 Hz with the torque held over each sample and a little noise.
SimulationSpec rrp_run(double duration_s);

/// The same with one fault that stays, or that ends after `length_s`.
SimulationSpec rrp_run_with(FaultKind kind, Joint joint, double onset_s, double size = 0.0,
                            double length_s = 1e9);

/// Its usual motion in two healthy simulated runs; the same object every time.
const UsualMotion& rrp_usual_motion();

}  // namespace faultline
