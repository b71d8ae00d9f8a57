// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/progress.hpp"
#include "lib/reproduce/page/reproduction.hpp"
#include "lib/reproduce/page/result_table.hpp"
#include "lib/reproduce/protocol/reproduce_options.hpp"

namespace faultline {

/// The paper's figures 1 and 2 as runs: detection of a free-swinging joint at any time by single networks, by
/// both with a case-based decision, by this project's own way and by a near-optimal reference, under every
/// controller and noise reading.
StudyResult run_study(const ReproduceOptions& options, const Progress& progress = {});

/// The paper's figures 3 to 8: residual, position and velocity of joint 2, which swings freely from 4 s (MLP)
/// or 5 s (RBFN) on, with what the networks put out. Held controller, no noise, the paper's own recipe.
std::vector<Figure> fault_figures(const ReproduceOptions& options);

}  // namespace faultline
