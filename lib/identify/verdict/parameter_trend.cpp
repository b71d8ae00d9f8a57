// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/parameter_trend.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "lib/core/matrix/decompositions.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/identify/torque_fit.hpp"
#include "lib/identify/weak_form/weak_form.hpp"
#include "lib/log/time_axis.hpp"

namespace faultline {
namespace {

constexpr int kTests = 2;  // tests of each parameter
constexpr double kScatters =
    0.05;  // probability below which logs scatter about the line beyond their own std

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
  return run.time_s.size() < 2 ? kLongest_s : std::max(median_step(run.time_s), 1e-9);
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

/// One log's rows of the system, and the fit to them.
struct SingleLog {
  int log = 0;
  WeakSystem system;
  WeakFit fit;
  std::vector<int> columns;       ///< fitted parameters
  std::vector<ResidualRun> runs;  ///< by joint
};

/// Returns some rows of a log with blocks of their own, which may be shorter than those of all logs.
WeakSystem rows_of_log(const WeakSystem& all, const std::vector<int>& rows) {
  WeakSystem out;
  out.a = all.a(rows, Eigen::all);
  out.y = all.y(rows);
  out.use = all.use(rows);
  out.joints = all.joints;
  out.width = all.width;
  std::set<long> seconds;
  for (const int k : rows) {
    out.joint.push_back(all.joint[k]);
    out.log.push_back(all.log[k]);
    out.time_s.push_back(all.time_s[k]);
    seconds.insert(static_cast<long>(std::floor(all.time_s[k])));
  }
  return with_blocks(std::move(out), static_cast<double>(seconds.size()));
}

std::vector<ResidualRun> runs_by_joint(const SingleLog& s) {
  std::vector<ResidualRun> runs;
  for (int j = 0; j < s.system.joints; ++j) {
    std::vector<int> rows;
    for (std::size_t k = 0; k < s.system.joint.size(); ++k)
      if (s.system.joint[k] == j) rows.push_back(static_cast<int>(k));
    ResidualRun run{s.system.a(rows, s.columns), s.fit.weight(rows), s.fit.residual(rows), {}};
    for (const int k : rows) run.time_s.push_back(s.system.time_s[k]);
    runs.push_back(std::move(run));
  }
  return runs;
}

std::vector<SingleLog> fit_single_logs(const TorqueFit& torque) {
  std::map<int, std::vector<int>> rows;
  for (std::size_t k = 0; k < torque.system.log.size(); ++k)
    rows[torque.system.log[k]].push_back(static_cast<int>(k));
  std::vector<SingleLog> singles;
  if (rows.size() < kFitsFewestLogs) return singles;
  for (const auto& [log, of_log] : rows) {
    SingleLog& s = singles.emplace_back();
    s.log = log;
    s.system = rows_of_log(torque.system, of_log);
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

/// Weighted sums over the logs of one parameter.
struct TrendSums {
  double weight = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
};

double weight_of(const LogValue& v) { return 1.0 / (v.std * v.std); }

TrendSums sums_of(const std::vector<LogValue>& values) {
  TrendSums s;
  for (const LogValue& v : values) s.weight += weight_of(v);
  for (const LogValue& v : values) {
    s.x += weight_of(v) * v.log / s.weight;
    s.y += weight_of(v) * v.value / s.weight;
  }
  for (const LogValue& v : values) {
    s.xx += weight_of(v) * (v.log - s.x) * (v.log - s.x);
    s.xy += weight_of(v) * (v.log - s.x) * (v.value - s.y);
  }
  return s;
}

ParameterTrend tested(ParameterTrend t) {
  const TrendSums s = sums_of(t.by_log);
  const int logs = static_cast<int>(t.by_log.size());
  t.mean = s.y;
  t.slope = s.xy / s.xx;
  double about_line = 0.0;
  for (const LogValue& v : t.by_log) {
    const double from_mean = v.value - t.mean, from_line = from_mean - t.slope * (v.log - s.x);
    t.chi_square += weight_of(v) * from_mean * from_mean;
    about_line += weight_of(v) * from_line * from_line;
  }
  t.p_same = chi_square_tail(t.chi_square, logs - 1);
  const double scatter = about_line / (logs - 2);
  const bool scatters = chi_square_tail(about_line, logs - 2) < kScatters;
  t.slope_std = std::sqrt((scatters ? scatter : 1.0) / s.xx);
  const double ratio = t.slope / t.slope_std;
  t.p_level = scatters ? student_tail(ratio, logs - 2) : normal_tail(ratio);
  return t;
}

}  // namespace

std::vector<ParameterTrend> tested_trends(std::vector<ParameterTrend> trends) {
  for (ParameterTrend& t : trends) t = tested(std::move(t));
  const double level = kFalseFlags / (kTests * std::max<double>(static_cast<double>(trends.size()), 1.0));
  for (ParameterTrend& t : trends) {
    t.differs = t.p_same < level;
    t.drifts = t.p_level < level;
  }
  return trends;
}

std::vector<ParameterTrend> parameter_trends(const TorqueFit& torque) {
  const ParameterSpace& space = torque.space;
  const std::vector<SingleLog> singles = fit_single_logs(torque);
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
