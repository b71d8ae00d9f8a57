// SPDX-License-Identifier: MIT
#pragma once

#include "lib/core/progress.hpp"
#include "lib/reproduce/page/result_table.hpp"
#include "lib/reproduce/protocol/reproduce_options.hpp"

namespace faultline {

/// The paper's figures 1 and 2 as runs: detection of a free-swinging joint at any time by single networks, by
/// both with a case-based decision, by this project's own way and by a near-optimal reference, under every
/// controller and noise reading.
StudyResult run_study(const ReproduceOptions& options, const Progress& progress = {});

}  // namespace faultline
