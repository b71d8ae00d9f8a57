// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/identify/days/healthy_day.hpp"

namespace faultline {

/// The draft with the noise of its rows by what robot and days leave unexplained. `order`: of the
/// autoregression.
DayDraft with_noise(DayDraft draft, int order);

/// Robot and effects of all days together: the robot's parameters free, the effects random.
struct MixedEffects {
  DayDraft draft;           ///< with parameters and effects
  Eigen::VectorXd moments;  ///< second moments of the effects about their mean, their doubt included
};

/// Best linear unbiased prediction (equation (7) of docs/how-it-works.md; Henderson 1950), given the variance
/// `between` the days. The normal matrix is an arrow: the robot, and a block for each day, which is
/// eliminated.
MixedEffects fit_mixed_effects(DayDraft draft, const Eigen::VectorXd& between);

/// The robot as all days but one show it, noise and what is not linear as by all.
struct RobotWithoutDay {
  Eigen::VectorXd theta;
  Eigen::VectorXd moments;  ///< as MixedEffects has them
};

/// One for each day, from the same normal equations.
std::vector<RobotWithoutDay> fit_without_each_day(const DayDraft& draft, const Eigen::VectorXd& between);

}  // namespace faultline
