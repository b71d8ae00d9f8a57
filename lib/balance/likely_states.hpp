// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace faultline {

/// Returns the most likely sequence of two states, by row 0 or 1 (Viterbi 1967). `nats`: rows x 2, the cost
/// of each row in each state; each change of the state costs `price` nats.
std::vector<char> likely_states(const Eigen::MatrixX2d& nats, double price);

}  // namespace faultline
