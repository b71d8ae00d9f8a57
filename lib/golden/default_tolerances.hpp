// SPDX-License-Identifier: MIT
#pragma once

#include "lib/golden/observation.hpp"
#include "lib/golden/tolerance.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// What record writes for all logs: times within two samples, predicted motion within a fiftieth of the noise
/// of a healthy log, residuals within 2 %. Arithmetic differs between machines by far less; a change of the
/// program or of the model that a user would notice is more.
Tolerances default_tolerances(const Model& model);

/// For each identified parameter a tenth of its standard deviation.
Tolerances default_tolerances(const ObservedIdentification& identification);

}  // namespace faultline
