// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>

#include "lib/log/log_source.hpp"

/// Robots whose drives move more than one joint: q = C q_logged, with the square matrix C constant and
/// regular. Power is the same on both sides, so tau = C^-T tau_logged.
namespace faultline {

/// The joints' channels of a log that recorded the drives': q, dq, q_ref and dq_ref by C, torques by C^-T. A
/// missing value makes those missing that depend on it. Without a matrix (0 x 0) the log as it is. next()
/// throws Error(input) when the log has another number of joints.
std::unique_ptr<LogSource> coupled(std::unique_ptr<LogSource> source, const Eigen::MatrixXd& coupling);

/// What the drives of that robot record while its joints do what `log` says.
Log uncoupled(Log log, const Eigen::MatrixXd& coupling);

}  // namespace faultline
