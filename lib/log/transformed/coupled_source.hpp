// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>

#include "lib/log/log_source.hpp"

/// Robots whose drives move more than one joint: q = C q_logged, with the square matrix C constant and
/// regular. Power is the same on both sides, so tau = C^-T tau_logged.
namespace faultline {

/// Returns the joint log of a log of the drives: q, dq, q_ref and dq_ref multiplied by C, torques by C^-T. A
/// missing value makes all values missing that depend on it. Without a matrix (0 x 0) the log is unchanged.
/// next() throws Error(input) if the log has another number of joints.
std::unique_ptr<LogSource> coupled(std::unique_ptr<LogSource> source, const Eigen::MatrixXd& coupling);

/// Returns the log that the drives of that robot record for the joint log `log`.
Log uncoupled(Log log, const Eigen::MatrixXd& coupling);

}  // namespace faultline
