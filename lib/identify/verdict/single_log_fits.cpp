// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "lib/core/distributions.hpp"
#include "lib/core/matrix/decompositions.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/identify/torque_fit.hpp"
#include "lib/identify/verdict/parameter_trend.hpp"
#include "lib/identify/verdict/residual_pattern.hpp"
#include "lib/identify/weak_form/weak_form.hpp"

namespace faultline {
namespace {

constexpr std::size_t kFitsFewestLogs = 3;  // two logs always lie on a line: its scatter needs a third

constexpr double kLongest_s = 1.0;   // over which residuals may be correlated
constexpr double kNoiseGap = 1.5;    // times the expected time of so many windows: longer is a gap
constexpr double kFullWeight = 0.5;  // of the largest weight: less is an outlier or a joint at rest

/// Consecutive windows of one joint in one log, with the residual of their own fit.
struct ResidualRun {
  Eigen::MatrixXd a;         ///< windows x fitted parameters
  Eigen::VectorXd weight;    ///< weight of each in the fit
  Eigen::VectorXd residual;  ///< N m or N
  std::vector<double> time_s;
};

double usual_step(const ResidualRun& run) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < run.time_s.size(); ++k) steps.push_back(run.time_s[k] - run.time_s[k - 1]);
  return steps.empty() ? kLongest_s : std::max(upper_median(std::move(steps)), 1e-9);
}

/// Returns the mean product of residuals by distance in windows, from 0 on, over the runs of one joint,
/// tapered to zero (Newey and West 1987). Windows that a fit weighs down do not count.
std::vector<double> autocovariance(const std::vector<const ResidualRun*>& runs) {
  std::size_t lags = 0;
  for (const ResidualRun* run : runs)
    lags = std::max(lags, static_cast<std::size_t>(std::ceil(kLongest_s / usual_step(*run))));
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

/// Returns what residuals of that autocovariance add to the covariance of a run's weighted sum a^T W r.
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

/// One log's rows of the system, the start times of its windows, and the fit to them.
struct SingleLog {
  int log = 0;
  WeakSystem system;
  std::vector<double> time_s;
  WeakFit fit;
  std::vector<int> columns;       ///< fitted parameters
  std::vector<ResidualRun> runs;  ///< by joint
};

/// Returns the start time of the window of each row of the system.
std::vector<double> times_of(const std::vector<JointFit>& fits) {
  std::vector<double> times;
  for (const JointFit& fit : fits) times.insert(times.end(), fit.time_s.begin(), fit.time_s.end());
  return times;
}

WeakSystem rows_of_log(const WeakSystem& all, const std::vector<int>& rows) {
  WeakSystem out;
  out.a = all.a(rows, Eigen::all);
  out.y = all.y(rows);
  out.use = all.use(rows);
  out.joints = all.joints;
  out.width = all.width;
  for (const int k : rows) {
    out.joint.push_back(all.joint[k]);
    out.log.push_back(all.log[k]);
  }
  return out;
}

/// Returns the rows of one log with blocks of its own, which may be shorter than those of all logs.
WeakSystem with_blocks(WeakSystem system, const std::vector<double>& time_s) {
  std::set<long> seconds;
  for (const double t : time_s) seconds.insert(static_cast<long>(std::floor(t)));
  const double block_s =
      residual_block_s(static_cast<double>(seconds.size()), static_cast<double>(system.a.cols()));
  std::map<long, int> blocks;
  for (const double t : time_s)
    system.block.push_back(
        blocks.emplace(static_cast<long>(std::floor(t / block_s)), static_cast<int>(blocks.size()))
            .first->second);
  system.blocks = static_cast<int>(blocks.size());
  return system;
}

std::vector<ResidualRun> runs_by_joint(const SingleLog& s) {
  std::vector<ResidualRun> runs;
  for (int j = 0; j < s.system.joints; ++j) {
    std::vector<int> rows;
    for (std::size_t k = 0; k < s.system.joint.size(); ++k)
      if (s.system.joint[k] == j) rows.push_back(static_cast<int>(k));
    ResidualRun run{s.system.a(rows, s.columns), s.fit.weight(rows), s.fit.residual(rows), {}};
    for (const int k : rows) run.time_s.push_back(s.time_s[k]);
    runs.push_back(std::move(run));
  }
  return runs;
}

std::vector<SingleLog> fit_single_logs(const TorqueFit& torque, const std::vector<JointFit>& fits) {
  const std::vector<double> times = times_of(fits);
  std::map<int, std::vector<int>> rows;
  for (std::size_t k = 0; k < torque.system.log.size(); ++k)
    rows[torque.system.log[k]].push_back(static_cast<int>(k));
  std::vector<SingleLog> singles;
  if (rows.size() < kFitsFewestLogs) return singles;
  for (const auto& [log, of_log] : rows) {
    SingleLog& s = singles.emplace_back();
    s.log = log;
    for (const int k : of_log) s.time_s.push_back(times[k]);
    s.system = with_blocks(rows_of_log(torque.system, of_log), s.time_s);
    s.fit = fit_weak_form(s.system, torque.space, torque.fit.parameters, torque.wanted);
    for (int c = 0; c < s.system.a.cols(); ++c)
      if (s.fit.free[c]) s.columns.push_back(c);
    s.runs = runs_by_joint(s);
  }
  return singles;
}

/// Returns the variances of a log's parameters if its residual has the autocovariance `alike` of all logs.
Eigen::VectorXd pooled_variances(const SingleLog& s, const std::vector<std::vector<double>>& alike) {
  const auto m = static_cast<Eigen::Index>(s.columns.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(m, m), sum = normal;
  for (std::size_t j = 0; j < s.runs.size(); ++j) {
    const ResidualRun& run = s.runs[j];
    if (run.a.rows() == 0) continue;
    normal += run.a.transpose() * run.weight.asDiagonal() * run.a;
    sum += covariance_of_sum(run, alike[j]);
  }
  const Eigen::MatrixXd bread = inverse_definite(normal);
  return (bread * sum * bread).diagonal();
}

}  // namespace

std::vector<ParameterTrend> parameter_trends(const TorqueFit& torque, const std::vector<JointFit>& fits) {
  const ParameterSpace& space = torque.space;
  const std::vector<SingleLog> singles = fit_single_logs(torque, fits);
  if (singles.empty()) return {};
  std::vector<std::vector<double>> alike;  // autocovariance by joint
  for (int j = 0; j < torque.system.joints; ++j) {
    std::vector<const ResidualRun*> runs;
    for (const SingleLog& s : singles) runs.push_back(&s.runs[j]);
    alike.push_back(autocovariance(runs));
  }
  std::vector<ParameterTrend> trends(space.linear());
  for (int p = 0; p < space.linear(); ++p) {
    trends[p].name = space.name(p);
    trends[p].unit = space.unit(p);
  }
  for (const SingleLog& s : singles) {
    const Eigen::VectorXd pooled = pooled_variances(s, alike);
    for (std::size_t i = 0; i < s.columns.size(); ++i) {
      const int p = s.columns[i];
      const double std = std::sqrt(std::max(pooled[static_cast<Eigen::Index>(i)], s.fit.covariance(p, p)));
      const double value = s.fit.parameters[p];
      if (s.fit.confounded[p] || !(std > 0.0) || !std::isfinite(std)) continue;
      trends[p].by_log.push_back({s.log, value, std, {value - kNormal95 * std, value + kNormal95 * std}});
    }
  }
  std::erase_if(trends, [](const ParameterTrend& t) { return t.by_log.size() < kFitsFewestLogs; });
  return tested_trends(std::move(trends));
}

}  // namespace faultline
