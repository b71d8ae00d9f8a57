// SPDX-License-Identifier: MIT
#pragma once

#include "lib/core/progress.hpp"
#include "lib/reproduce/page/result_table.hpp"
#include "lib/reproduce/protocol/reproduce_options.hpp"

namespace faultline {

/// Section V.A of the paper: how well the fault-free motion is predicted one sample ahead. The paper's
/// network by its own trainer and by Levenberg-Marquardt, its variants, physics and hybrid; tables
/// generator_mse, generator_by_output, generator_friction.
StudyResult generator_study(const ReproduceOptions& options, const Progress& progress = {});

}  // namespace faultline
