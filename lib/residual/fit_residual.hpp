// SPDX-License-Identifier: MIT
#pragma once

#include "lib/core/progress.hpp"
#include "lib/neural/training.hpp"
#include "lib/residual/learn_residual.hpp"
#include "lib/residual/residual_generator.hpp"
#include "lib/residual/transitions.hpp"

namespace faultline {

/// Trains the network of `generator`, whose kind, target, shape and chain are set, on these transitions of
/// healthy motion, all of them finite; scalers take the range of `training`. `validation` may be empty. Kind
/// physics has nothing to train: the summary is then "not run".
TrainingSummary fit_residual_generator(ResidualGenerator& generator, const Transitions& training,
                                       const Transitions& validation, const ResidualOptions& options,
                                       const Progress& progress = {});

/// Sets `generator.healthy` from transitions of healthy motion that were not trained on.
void measure_healthy(ResidualGenerator& generator, const Transitions& check);

}  // namespace faultline
