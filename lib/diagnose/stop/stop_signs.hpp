// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "lib/explain/balance_course.hpp"

namespace faultline {

/// A stretch in which a signal was outside of its healthy range.
struct Deviation {
  double start_s = 0.0;
  double last_s = 0.0;  ///< the last time that adds to the evidence for it
};

/// A stretch that begins within this time after the last one belongs to the same sign: so do parts of a fault
/// that are merged in a diagnosis.
inline constexpr double kSignPause_s = 1.0;

/// Nats that a healthy row costs at most, on average 0.5: a row of 1.7 standard deviations. The evidence of a
/// row is the excess over it.
inline constexpr double kNatsOfHealthyRow = 1.5;
/// The same, by which a deviation is dated if it is so large: a row of 3 standard deviations. Small errors of
/// the model before a deviation do not count.
inline constexpr double kNatsOfAnyHealthyRow = 4.5;

/// Returns the deviations of joint `j` (from 0) by cumulative sums (Page 1954): the evidence of successive
/// rows, 0.5 square - kNatsOfHealthyRow, begins anew when it falls to 0. A deviation reaches `limit` nats. It
/// starts with the first row of the sum with kNatsOfAnyHealthyRow, if that reaches the limit, too.
std::vector<Deviation> balance_deviations(const BalanceCourse& course, int j, double limit);

/// Returns the number of samples beyond the largest of `patterns` healthy ones that `samples` healthy samples
/// reach with a probability of at most `chance`, if samples are independent: each is beyond with probability
/// 1 / (patterns + 1), and the number has Poisson's distribution. At least 1.
int samples_by_chance(int samples, int patterns, double chance);

/// Returns the deviations of a series of magnitudes: blocks of `block` samples in which at least `enough` are
/// beyond `largest`; successive blocks are one deviation. The last block ends with the last sample.
std::vector<Deviation> sample_deviations(const std::vector<double>& time_s,
                                         const std::vector<double>& magnitude, double largest, int block,
                                         int enough);

/// Returns the deviation that lasts, or returns after pauses of at most kSignPause_s, up to the last
/// `moment_s` before the stop: from its first start on. Empty if there is none.
std::optional<Deviation> lasting_deviation(const std::vector<Deviation>& deviations, double stop_s,
                                           double moment_s);

}  // namespace faultline
