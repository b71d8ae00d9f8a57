// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/correlated_noise.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr double kLongest_s = 1.0;   // over which residuals may be alike
constexpr double kNoiseGap = 1.5;    // times as long as so many windows should last is a gap
constexpr double kFullWeight = 0.5;  // of the largest: less is an outlier or a joint at rest

double usual_step(const ResidualRun& run) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < run.time_s.size(); ++k) steps.push_back(run.time_s[k] - run.time_s[k - 1]);
  return steps.empty() ? kLongest_s : std::max(upper_median(std::move(steps)), 1e-9);
}

std::size_t longest_lag(const ResidualRun& run) {
  return static_cast<std::size_t>(std::ceil(kLongest_s / usual_step(run)));
}

}  // namespace

std::vector<double> autocovariance(const std::vector<const ResidualRun*>& runs) {
  std::size_t lags = 0;
  for (const ResidualRun* run : runs) lags = std::max(lags, longest_lag(*run));
  std::vector<double> sum(lags + 1, 0.0), count(lags + 1, 0.0);
  for (const ResidualRun* run : runs) {
    const double step_s = usual_step(*run);
    const double least = kFullWeight * (run->weight.size() > 0 ? run->weight.maxCoeff() : 0.0);
    const std::size_t rows = run->time_s.size();
    for (std::size_t k = 0; k < rows; ++k)
      for (std::size_t lag = 0; lag <= lags && k + lag < rows; ++lag) {
        const double apart_s = run->time_s[k + lag] - run->time_s[k];
        if (apart_s > kNoiseGap * step_s * static_cast<double>(lag)) break;
        if (!(run->weight[k] > least && run->weight[k + lag] > least)) continue;
        sum[lag] += run->residual[k] * run->residual[k + lag];
        count[lag] += 1.0;
      }
  }
  for (std::size_t lag = 0; lag <= lags; ++lag) {
    const double taper = 1.0 - static_cast<double>(lag) / static_cast<double>(lags + 1);
    sum[lag] = count[lag] > 0.0 ? taper * sum[lag] / count[lag] : 0.0;
  }
  return sum;
}

Eigen::MatrixXd covariance_of_sum(const ResidualRun& run, const std::vector<double>& autocovariance) {
  const double step_s = usual_step(run);
  const Eigen::MatrixXd u = run.weight.asDiagonal() * run.a;
  Eigen::MatrixXd ahead = 0.5 * autocovariance[0] * u;
  for (Eigen::Index k = 0; k < u.rows(); ++k)
    for (std::size_t lag = 1; lag < autocovariance.size() && k + static_cast<Eigen::Index>(lag) < u.rows();
         ++lag) {
      const auto other = k + static_cast<Eigen::Index>(lag);
      if (run.time_s[other] - run.time_s[k] > kNoiseGap * step_s * static_cast<double>(lag)) break;
      ahead.row(k) += autocovariance[lag] * u.row(other);
    }
  const Eigen::MatrixXd half = u.transpose() * ahead;
  return half + half.transpose();
}

}  // namespace faultline
