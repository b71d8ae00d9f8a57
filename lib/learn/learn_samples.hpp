// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/learn/twin_study.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Trains the paper's classifiers on the residuals of simulated runs and tunes both criteria on every third
/// of them, which it does not train on. It uses all healthy runs, and the first few runs of each label whose
/// fault shows in every sample while it lasts.
SampleMode learn_sample_mode(const Model& model, std::vector<LabelledResiduals> runs);

}  // namespace faultline
