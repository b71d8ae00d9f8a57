// SPDX-License-Identifier: MIT
#pragma once

namespace faultline::testing {

/// A robot with every torque that few have: load friction, bent and lopsided friction, a ripple, a drive that
/// two joints turn.
inline const char* const kExtraTorqueRobot = R"(
axes = "RRP"
[friction]
viscous = [0.5, 0.3, 2.0]
coulomb = [0.6, 0.4, 1.0]
offset = [0.1, -0.2, 0.0]
bend = [-0.2, 0.0, 0.0]
skew = [0.0, 0.05, 0.0]
load = [0.1, 0.0, 0.2]
[[ripple]]
joint = 2
rate = 40
cosine = 0.3
sine = -0.2
[[shared_drive]]
along = [1, 1, 0]
viscous = 0.4
coulomb = 1.5
width = 0.02
rotor_inertia = 0.05
)";

}  // namespace faultline::testing
