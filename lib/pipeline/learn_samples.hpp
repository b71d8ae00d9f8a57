// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/model/model.hpp"
#include "lib/pipeline/twin_study.hpp"

namespace faultline {

/// Of simulated runs, the residuals that single samples are judged by: of healthy runs, and of kinds that
/// show in every sample while they last, a few runs of each label. The runs keep none.
std::vector<LabelledResiduals> residuals_of_samples(std::vector<MonitoredRun>& runs);

/// Trains the paper's classifiers on the residuals of simulated runs and tunes both criteria on every third
/// of them, which it does not train on.
SampleMode learn_sample_mode(const Model& model, std::vector<LabelledResiduals> runs);

}  // namespace faultline
