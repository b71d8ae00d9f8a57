// SPDX-License-Identifier: MIT
#include "lib/explain/balance_course.hpp"

#include <limits>

#include "lib/balance/rows.hpp"
#include "lib/explain/free_form.hpp"
#include "lib/explain/log_fit.hpp"

namespace faultline {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Returns the whitened effect of 1 N m or N on joint `j` alone.
Eigen::VectorXd unit_effect(const LogFit& fit, int j) {
  Stacked torque = Stacked::Zero(fit.joints() * fit.count());
  torque.segment(j * fit.count(), fit.count()).setOnes();
  return fit.whitened(torque).segment(j * fit.count(), fit.count());
}

BalanceCourse course_of_rows(const LogFit& fit) {
  const Stacked left =
      fit.whitened(torque_without_piece(fit)) - fit.white_effects().times(first_change(fit).day);
  const int rows = fit.count();
  BalanceCourse out;
  out.time_s.assign(fit.time_s().begin(), fit.time_s().end());
  out.reach_s = reach_s(fit.model().setting);
  out.square.resize(rows, fit.joints());
  out.unit_square.resize(rows, fit.joints());
  for (int j = 0; j < fit.joints(); ++j) {
    out.unit_square.col(j) = unit_effect(fit, j).cwiseAbs2();
    for (int k = 0; k < rows; ++k)
      out.square(k, j) = fit.std()(k, j) < kNoWeight ? Eigen::numext::abs2(left[j * rows + k]) : kUnknown;
  }
  return out;
}

}  // namespace

std::optional<BalanceCourse> balance_course(const UniformLog& log, const ExplainModel& model) {
  const auto* balance = std::get_if<BalanceModel>(&model.robot);
  if (balance == nullptr) return std::nullopt;
  return course_of_rows(LogFit(averaged_as(log, model.robot), *balance));
}

}  // namespace faultline
