// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/weak_form/weak_form.hpp"

namespace faultline {

/// Sample period, s, below which a log shows the velocities at which friction bends, and its offset.
inline constexpr double kShowsFriction_s = 0.03;

/// Whether some log is fast enough to show friction offset and width.
bool has_fast_log(const Identification& id);

/// Facts that explain why parameters were not estimated.
struct TableFacts {
  std::vector<bool> asked;      ///< by parameter: the weak form should estimate it
  std::vector<Joint> still;     ///< joints that never move
  std::vector<Joint> undriven;  ///< joints of negligible torque
  std::vector<Joint> leaning;   ///< joints whose mass and rotor assume no friction offset
};

/// Returns what to record so that the motion determines a parameter.
std::string why_not_identifiable(const TableFacts& facts);

/// Returns the parameters of `id.space` with the values of `id.estimate` and `id.covariance`, except bent,
/// skew and extra terms of value 0; those that were not identified with the reason.
std::vector<ParameterEstimate> base_parameter_table(const WeakFit& weak, const TableFacts& facts,
                                                    const Identification& id);

/// Whether every base parameter but rotors, and all viscous and Coulomb friction, are identifiable.
bool all_identifiable(const Identification& id);

}  // namespace faultline
