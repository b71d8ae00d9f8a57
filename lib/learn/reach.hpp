// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/explain/least_found.hpp"
#include "lib/learn/twin_study.hpp"

namespace faultline {

/// How small a fault may be to be found, label by label in the order of the runs: the size that nine of ten
/// healthy logs show, each by least_found(); and how many of the simulated runs were found, and when. An
/// alarm before the onset finds nothing.
std::vector<Reach> reach_of(std::span<const MonitoredRun> runs,
                            const std::vector<std::vector<LeastFound>>& by_log);

}  // namespace faultline
