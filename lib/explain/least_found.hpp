// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/balance/uniform_log.hpp"
#include "lib/explain/explain_log.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {

/// The smallest fault of a kind at a joint that a log would show.
struct LeastFound {
  FaultLabel label;
  double size = 0.0;  ///< share, rad, m, N m, N, kg and so on, of a collision its impulse; infinite for none
};

/// Returns, for each label whose kind has a size, the smallest fault of a healthy log that gives more
/// evidence than its limit nine of ten times, if it begins in the middle of the log and lasts to its end (a
/// collision for kUsualPush_s). In closed form, from the columns of the fault (equation (13) of
/// docs/how-it-works.md). Empty if the log cannot be explained.
std::vector<LeastFound> least_found(const UniformLog& healthy, const ExplainModel& model,
                                    const std::vector<FaultLabel>& labels);
/// Returns the same for faults that begin at `onset_s`.
std::vector<LeastFound> least_found(const UniformLog& healthy, const ExplainModel& model,
                                    const std::vector<FaultLabel>& labels, double onset_s);

inline constexpr double kUsualPush_s = 0.1;  ///< length of the collision whose smallest size is given

/// Returns the size along `direction` from which on the evidence exceeds `limit` (nats) nine of ten times, if
/// the sizes of a hypothesis have a prior `variance` and, given the rows of a log, the posterior
/// `covariance`. Infinite if the rows hold no information on that direction.
double least_size_found(const Eigen::MatrixXd& covariance, const Eigen::VectorXd& variance,
                        const Eigen::VectorXd& direction, double limit);

}  // namespace faultline
