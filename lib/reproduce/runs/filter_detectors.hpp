// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "lib/learn/learn.hpp"
#include "lib/reproduce/runs/free_joint_filter.hpp"
#include "lib/reproduce/runs/run_condition.hpp"

namespace faultline {

/// Filters for the healthy robot and each free joint, the threshold of their summed log likelihood ratio
/// chosen on `tuning`; the fault is named 0.6 s after the alarm, as `diagnose` does.
DetectorResult watch_with_filters(const std::string& detector, const FilteredRobot& robot,
                                  std::span<const ExperimentRun> tuning, std::span<const ExperimentRun> test);

/// What `diagnose` says with this model, named by either network alone and by both with cases.
std::vector<DetectorResult> watch_with_product(const Learned& learned, std::span<const ExperimentRun> test);

/// The first `faulty` faulty runs and fault-free ones of about `fault_free_h` hours.
std::vector<ExperimentRun> some_of(std::span<const ExperimentRun> runs, int faulty, double fault_free_h);

}  // namespace faultline
