// SPDX-License-Identifier: MIT
#pragma once

#include "lib/core/progress.hpp"
#include "lib/reproduce/page/result_table.hpp"
#include "lib/reproduce/protocol/reproduce_options.hpp"

namespace faultline {

/// The paper's tables 1 and 2: the training set of the classifier of single samples, its errors as the paper
/// built it, what each departure buys, and what the true model could do at best. All three controllers.
StudyResult classifier_study(const ReproduceOptions& options = {}, const Progress& progress = {});

}  // namespace faultline
