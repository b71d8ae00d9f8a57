// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/model/model.hpp"
#include "lib/pipeline/twin_study.hpp"

namespace faultline {

/// Trains the paper's classifiers on the residuals of simulated runs and tunes both criteria on every third
/// of them, which it does not train on. Healthy runs count, and of each label whose faults show in every
/// sample while they last the first few.
SampleMode learn_sample_mode(const Model& model, std::vector<LabelledResiduals> runs);

}  // namespace faultline
