// SPDX-License-Identifier: MIT
#pragma once

#include "lib/evidence/learn/learn_motion_model.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// The beginning of a model: the identified robot, the usual sample period of its logs, and the bank of
/// hypotheses that follows from them.
Model identified_model(const Identification& identification);

/// What the filters need of the identification.
IdentifiedMotion identified_motion(const Identification& identification);

}  // namespace faultline
