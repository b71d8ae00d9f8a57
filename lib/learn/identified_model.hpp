// SPDX-License-Identifier: MIT
#pragma once

#include "lib/model/model.hpp"

namespace faultline {

/// Usual sample period of the logs.
double identified_period_s(const Identification& identification);

/// The beginning of a model: the identified robot and the usual sample period of its logs.
Model identified_model(const Identification& identification);

}  // namespace faultline
