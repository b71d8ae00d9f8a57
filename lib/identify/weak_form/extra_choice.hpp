// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/weak_form/weak_choice.hpp"

namespace faultline {

/// Returns the choice with those extra terms of `asked` that lower the error on held-out data, the most
/// promising first. Cosine and sine of a ripple, viscous and Coulomb friction of a shared drive go together.
ModelChoice choose_extra(const Chooser& chooser, const std::vector<bool>& asked, ModelChoice choice);

/// Returns the choice with the gains of torques that are logged too large or too small by a factor: those of
/// joints that contradict the torques of the other joints unless scaled. The first joint of `counts` is the
/// reference. `counts`: joints to be used.
ModelChoice choose_gains(const Chooser& chooser, const std::vector<bool>& counts, ModelChoice choice);

}  // namespace faultline
