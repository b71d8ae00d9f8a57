// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/pipeline/twin_study.hpp"

namespace faultline {

/// How small a fault may be to be found, label by label in the order of the runs: from which size on nine of
/// ten are, with the share found never falling with the size (isotonic regression, Ayer et al. 1955). An
/// alarm before the onset finds nothing.
std::vector<Reach> reach_of(std::span<const MonitoredRun> runs);

}  // namespace faultline
