// SPDX-License-Identifier: MIT
#pragma once

#include "lib/core/progress.hpp"
#include "lib/reproduce/page/reproduction.hpp"

namespace faultline {

/// Runs the whole reproduction; the same options but `threads` give the same numbers.
Reproduction reproduce(const ReproduceOptions& options = {}, const Progress& progress = {});

}  // namespace faultline
