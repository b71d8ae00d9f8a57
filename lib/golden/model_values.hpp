// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/parameter_value.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// What a model judges by, as numbers with names that golden.toml can give tolerances to: the parameters of
/// its robot ("model_a", "model_fv_1", with the standard deviation they were identified with, as far as the
/// model keeps it), "trigger", "threshold" (nats) and those of faults that need more ("threshold_locked_2").
std::vector<ParameterValue> values_of(const Model& model);

}  // namespace faultline
