// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/explain/least_found.hpp"
#include "lib/learn/twin_study.hpp"

namespace faultline {

/// Returns the reach of each label, in the order of the runs: the smallest size that is found in nine of ten
/// healthy logs (`by_log`: least_found() of each), and number and median delay of the simulated runs that
/// were found. An alarm before the onset does not count.
std::vector<Detectability> detectability_of(std::span<const MonitoredRun> runs,
                                            const std::vector<std::vector<LeastFound>>& by_log);

}  // namespace faultline
