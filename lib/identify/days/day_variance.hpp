// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/balance_model.hpp"

namespace faultline {

/// Variance of the effects of a day (see DayLayout) before any day was looked at.
Eigen::VectorXd first_day_variance(const BalanceModel& model);

/// Variance between the days from the second moments of their effects: at least what a few days cannot show,
/// and none where an effect cannot be told from another.
Eigen::VectorXd variance_between_days(const BalanceModel& model, const Eigen::VectorXd& moments);

/// Prior of a day that was never seen: twice the variance between the days, and what few days cannot show.
Eigen::VectorXd prior_of_a_day(const BalanceModel& model, const Eigen::VectorXd& between);

}  // namespace faultline
