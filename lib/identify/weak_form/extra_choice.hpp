// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/weak_form/chooser.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"

namespace faultline {

/// Takes those extra terms that `asked` allows, and that pay on held-out data, into the choice, those first
/// that promise most. Cosine and sine of a ripple, viscous and Coulomb friction of a shared drive go
/// together.
void choose_extra(const Chooser& chooser, const ParameterSpace& space, const std::vector<bool>& asked,
                  ModelChoice& choice);

/// Finds torques that are logged too large or small by a factor: those of the joints which the others'
/// torques contradict and a factor mends, against the first joint that counts. `counts` says which joints do.
void choose_gains(const Chooser& chooser, const std::vector<bool>& counts, ModelChoice& choice);

}  // namespace faultline
