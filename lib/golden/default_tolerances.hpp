// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/golden/observation.hpp"
#include "lib/golden/tolerance.hpp"
#include "lib/identify/identification.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// What a model judges by, as numbers with names that golden.toml can give tolerances to: the parameters of
/// its robot ("model_a", "model_fv_1", with the standard deviation they were identified with, as far as the
/// model keeps it), "trigger", "threshold" (nats) and those of faults that need more ("threshold_locked_2").
std::vector<ParameterValue> values_of(const Model& model);

/// What record writes for all logs: times within two samples, predicted motion within a fiftieth of the noise
/// of a healthy log, residuals within 2 %. Arithmetic differs between machines by far less; a change of the
/// program or of the model that a user would notice is more.
Tolerances default_tolerances(const Model& model);

/// For each identified parameter a tenth of its standard deviation.
Tolerances default_tolerances(const ObservedIdentification& identification);

}  // namespace faultline
