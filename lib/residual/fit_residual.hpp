// SPDX-License-Identifier: MIT
#pragma once

#include "lib/core/progress.hpp"
#include "lib/neural/training.hpp"
#include "lib/residual/learn_residual.hpp"
#include "lib/residual/residual_generator.hpp"
#include "lib/residual/transitions.hpp"

namespace faultline {

/// A generator with its network, and how the training went.
struct FittedGenerator {
  ResidualGenerator generator;
  TrainingSummary training;  ///< not run for kind physics
};

/// Trains the network of `untrained`, whose kind, target, shape and chain are set, on these transitions of
/// healthy motion, all of them finite; scalers take the range of `training`. `validation` may be empty. Kind
/// physics has nothing to train.
FittedGenerator fit_residual_generator(ResidualGenerator untrained, const Transitions& training,
                                       const Transitions& validation, const ResidualOptions& options,
                                       const Progress& progress = {});

/// Returns the residuals of the generator on transitions of healthy motion that were not trained on. Its own
/// `healthy` may be empty.
HealthyResiduals healthy_residuals(ResidualGenerator generator, const Transitions& check);

}  // namespace faultline
