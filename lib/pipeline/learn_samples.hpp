// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lib/model/model.hpp"
#include "lib/twin/twin.hpp"

namespace faultline {

/// Trains the paper's classifiers on runs of the twin, one for each label and a few healthy ones, and tunes
/// both criteria on every third of them, which it does not train on. Needs model.residual.
SampleMode learn_sample_mode(const Twin& twin, const Model& model, const std::vector<FaultLabel>& labels,
                             std::uint64_t first_seed, int threads);

}  // namespace faultline
