// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/identify/weak_form/weak_form.hpp"

namespace faultline {

/// Logs at least this fast show the velocities where friction bends, and its offset.
inline constexpr double kShowsFriction_s = 0.03;

/// Why parameters were left out of the estimate.
struct TableFacts {
  std::vector<bool> asked;    ///< by parameter: the weak form was to estimate it
  std::vector<int> still;     ///< joints that never move, from 1
  std::vector<int> undriven;  ///< joints with next to no torque, from 1
  std::vector<int> leaning;   ///< joints whose mass and rotor lean on no friction offset, from 1
  bool fast = true;           ///< some log is faster than kShowsFriction_s
};

/// What to record so that the motion tells a parameter.
std::string not_excited(const std::vector<int>& still);
/// The same where joints may be still, hardly driven or lean on there being no friction offset, all from 1.
std::string why_not_told(const std::vector<int>& still, const std::vector<int>& undriven,
                         const std::vector<int>& leaning);

/// Fills id.base_parameters from id.estimate and id.covariance: every parameter of the space, those that
/// were not identified with the reason.
void list_base_parameters(const WeakFit& weak, const TableFacts& facts, Identification& id);

/// Whether the logs tell every mass, inertia and friction that they should.
bool all_told(const Identification& id);

}  // namespace faultline
