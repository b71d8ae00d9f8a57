// SPDX-License-Identifier: MIT
#include "lib/explain/day/own_noise.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lib/core/statistics.hpp"
#include "lib/explain/free_form.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rows that count for the noise in any case: s, and share of the log, from its first motion on, or from its
/// start if it changes before. A log at rest does not show its noise.
constexpr double kFirstStretch_s = 2.0, kFirstStretch = 0.3;
constexpr double kJustBefore_s = 0.2;  // s before the first motion: the kernels reach less far
constexpr double kMoves = 0.05;        // share of a joint's greatest healthy speed, from which it moves
constexpr double kLost = 1e3;          // times the least standard deviation: a row without weight
constexpr double kMostRows = 0.8, kFarLouder = 3.0;  // quantile, and times it: a larger row is no noise
constexpr double kMedianOfNoise = 0.6745;            // of the size of normal noise of unit variance
constexpr double kOutlier = 6.0;   // times the median row of a joint: 4 standard deviations of normal noise
constexpr int kOutlierRounds = 6;  // rounds that estimate effects of the day and find outliers in turn

/// Returns the size beyond which a row after a change belongs to a fault and is no noise: far above most rows
/// of the log's motion.
double largest_noise(const Eigen::Ref<const VectorXd>& rows, double usual) {
  const VectorXd size = rows.cwiseAbs();
  const double most = upper_quantile({size.begin(), size.end()}, kMostRows);
  return kFarLouder * std::max(usual, std::isnan(most) ? 0.0 : most);
}

/// Returns when any joint first moves; the time of the first row if none does.
double first_motion_s(const LogFit& fit) {
  const VectorXd& top = fit.model().top_speed;
  for (int k = 0; k < fit.count(); ++k)
    if ((fit.rows().dq.row(k).transpose().cwiseAbs().array() > kMoves * top.array()).any())
      return fit.time_s()[k];
  return fit.time_s()[0];
}

/// Returns whether rows have weight and no change of the work piece is near: rows x joints.
JointMask rows_of_noise(const LogFit& fit) {
  const std::vector<bool> near = near_change(fit.first_path(), kRowsOfChange);
  JointMask out = rows_with_weight(fit);
  for (int k = 0; k < static_cast<int>(near.size()); ++k)
    if (near[k]) out.row(k).setConstant(false);
  return out;
}

/// Returns the rows of `among` without outliers: rows far above the median row of their joint.
JointMask without_outliers(const LogFit& fit, const Stacked& torque, const JointMask& among) {
  JointMask out = among;
  for (int j = 0; j < fit.joints(); ++j) {
    const double usual = std::sqrt(autocovariance(fit.model().noise.joint[j])[0]);
    const VectorXd size =
        torque.segment(j * fit.count(), fit.count()).cwiseQuotient(fit.std().col(j)).cwiseAbs();
    std::vector<double> some;
    for (int k = 0; k < fit.count(); ++k)
      if (among(k, j)) some.push_back(size[k]);
    if (some.empty()) continue;
    const double most = kOutlier * std::max(upper_median(std::move(some)), kMedianOfNoise * usual);
    for (int k = 0; k < fit.count(); ++k) out(k, j) = among(k, j) && size[k] <= most;
  }
  return out;
}

/// Returns the rows of the whole log but outliers, beside effects of the day that are estimated without them.
CalmRows usual_rows(const LogFit& fit) {
  const Stacked residual = torque_without_piece(fit);
  const JointMask among = rows_of_noise(fit);
  CalmRows out{.torque = {}, .counts = among, .day = fit.healthy().day};
  for (int round = 0; round < kOutlierRounds; ++round) {
    JointMask counts = without_outliers(fit, residual - fit.day_torque(out.day), among);
    if (round > 0 && (counts == out.counts).all()) break;
    out.counts = std::move(counts);
    StackedMask dropped(residual.size(), false);
    for (int j = 0; j < fit.joints(); ++j) {
      const int reach = static_cast<int>(fit.noise().joint[j].filter.size()) - 1;
      for (int k = 0; k < fit.count(); ++k)
        if (!out.counts(k, j))
          for (int i = k; i < std::min(k + reach + 1, fit.count()); ++i) dropped[j * fit.count() + i] = true;
    }
    out.day = fit.explain(fit.residual(), {}, fit.first_path(), dropped).day;
  }
  out.torque = unstacked(residual - fit.day_torque(out.day), fit.joints());
  out.torque = out.counts.select(out.torque, 0.0);
  return out;
}

/// Returns the autocovariance of a joint's rows over their standard deviation.
VectorXd covariance_of(const CalmRows& calm, const LogFit& fit, int j) {
  const VectorXd usual = autocovariance(fit.model().noise.joint[j]);
  const VectorXd scaled = calm.torque.col(j).cwiseQuotient(fit.std().col(j).head(calm.torque.rows()));
  const double count = kRowsOfHealthyLogs + static_cast<double>(calm.counts.col(j).count());
  return (kRowsOfHealthyLogs * usual + lag_products(scaled, usual.size() - 1)) / count;
}

}  // namespace

JointMask rows_with_weight(const LogFit& fit) {
  JointMask out(fit.count(), fit.joints());
  for (int j = 0; j < fit.joints(); ++j)
    out.col(j) = fit.std().col(j).array() < kLost * fit.std().col(j).minCoeff();
  return out;
}

CalmRows calm_rows(const LogFit& fit) {
  const Change change = first_change(fit);
  const Stacked torque = torque_without_piece(fit) - fit.day_torque(change.day);
  const double motion_s = first_motion_s(fit),
               first_s = change.onset_s > motion_s - kJustBefore_s ? motion_s : fit.time_s()[0],
               length_s = fit.time_s()[fit.count() - 1] - first_s;
  const double until_s = std::max(change.onset_s - fit.model().setting.kernel_s,
                                  first_s + std::min(kFirstStretch_s, kFirstStretch * length_s));
  const int rows = fit.first_row(until_s), moving = std::min(rows, fit.first_row(first_s)),
            changed = fit.first_row(change.onset_s);
  CalmRows out{unstacked(torque, fit.joints()).topRows(rows), rows_of_noise(fit).topRows(rows), change.day};
  for (int j = 0; j < fit.joints(); ++j) {
    const VectorXd scaled = out.torque.col(j).cwiseQuotient(fit.std().col(j).head(rows));
    const double usual = std::sqrt(autocovariance(fit.model().noise.joint[j])[0]),
                 loudest = largest_noise(scaled.tail(rows - moving), usual);
    for (int k = changed; k < rows; ++k)
      out.counts(k, j) = out.counts(k, j) && std::abs(scaled[k]) <= loudest;
  }
  out.torque = out.counts.select(out.torque, 0.0);
  return out;
}

RowNoise own_noise(const LogFit& fit) {
  const CalmRows before = calm_rows(fit), most = usual_rows(fit);
  RowNoise out = fit.model().noise;
  for (int j = 0; j < fit.joints(); ++j) {
    JointNoise& noise = out.joint[j];
    const VectorXd one = covariance_of(before, fit, j), other = covariance_of(most, fit, j);
    const VectorXd& own = one[0] < other[0] ? one : other;
    if (own[0] > autocovariance(noise)[0]) noise = with_autocovariance(std::move(noise), own);
  }
  return out;
}

}  // namespace faultline
