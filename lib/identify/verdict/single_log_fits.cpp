// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/single_log_fits.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "lib/core/distributions.hpp"
#include "lib/core/matrix/decompositions.hpp"
#include "lib/identify/residual_blocks.hpp"
#include "lib/identify/verdict/correlated_noise.hpp"

namespace faultline {
namespace {

constexpr std::size_t kFitsFewestLogs = 3;  // two logs always lie on a line: its scatter needs a third

/// One log's rows of the system, where its windows began, and the fit to them.
struct SingleLog {
  int log = 0;
  WeakSystem system;
  std::vector<double> time_s;
  WeakFit fit;
  std::vector<int> columns;       ///< fitted
  std::vector<ResidualRun> runs;  ///< by joint
};

/// When the window of each row of the system began.
std::vector<double> times_of(const Identification& id) {
  std::vector<double> times;
  for (const JointFit& fit : id.joint_fits) times.insert(times.end(), fit.time_s.begin(), fit.time_s.end());
  return times;
}

void take_rows(const WeakSystem& all, const std::vector<int>& rows, WeakSystem& out) {
  out.a = all.a(rows, Eigen::all);
  out.y = all.y(rows);
  out.use = all.use(rows);
  out.joints = all.joints;
  out.width = all.width;
  for (const int k : rows) {
    out.joint.push_back(all.joint[k]);
    out.log.push_back(all.log[k]);
  }
}

/// Blocks of a log on its own may be shorter than those of all.
void number_blocks(SingleLog& s) {
  std::set<long> seconds;
  for (const double t : s.time_s) seconds.insert(static_cast<long>(std::floor(t)));
  const double block_s =
      residual_block_s(static_cast<double>(seconds.size()), static_cast<double>(s.system.a.cols()));
  std::map<long, int> blocks;
  for (const double t : s.time_s)
    s.system.block.push_back(
        blocks.emplace(static_cast<long>(std::floor(t / block_s)), static_cast<int>(blocks.size()))
            .first->second);
  s.system.blocks = static_cast<int>(blocks.size());
}

void keep_runs(SingleLog& s) {
  for (int c = 0; c < s.system.a.cols(); ++c)
    if (s.fit.free[c]) s.columns.push_back(c);
  for (int j = 0; j < s.system.joints; ++j) {
    std::vector<int> rows;
    for (std::size_t k = 0; k < s.system.joint.size(); ++k)
      if (s.system.joint[k] == j) rows.push_back(static_cast<int>(k));
    ResidualRun run{s.system.a(rows, s.columns), s.fit.weight(rows), s.fit.residual(rows), {}};
    for (const int k : rows) run.time_s.push_back(s.time_s[k]);
    s.runs.push_back(std::move(run));
  }
}

std::vector<SingleLog> fit_single_logs(const TorqueFit& torque, const Identification& id) {
  const std::vector<double> times = times_of(id);
  std::map<int, std::vector<int>> rows;
  for (std::size_t k = 0; k < torque.system.log.size(); ++k)
    rows[torque.system.log[k]].push_back(static_cast<int>(k));
  std::vector<SingleLog> singles;
  if (rows.size() < kFitsFewestLogs) return singles;
  for (const auto& [log, of_log] : rows) {
    SingleLog& s = singles.emplace_back();
    s.log = log;
    take_rows(torque.system, of_log, s.system);
    for (const int k : of_log) s.time_s.push_back(times[k]);
    number_blocks(s);
    s.fit = fit_weak_form(s.system, id.space, torque.fit.parameters, torque.wanted);
    keep_runs(s);
  }
  return singles;
}

/// Variances of a log's parameters when its residual is as alike over time as that of all logs is.
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

std::vector<std::vector<double>> autocovariances(const std::vector<SingleLog>& singles, int joints) {
  std::vector<std::vector<double>> alike;
  for (int j = 0; j < joints; ++j) {
    std::vector<const ResidualRun*> runs;
    for (const SingleLog& s : singles) runs.push_back(&s.runs[j]);
    alike.push_back(autocovariance(runs));
  }
  return alike;
}

}  // namespace

std::vector<ParameterTrend> parameter_trends(const TorqueFit& torque, const Identification& id) {
  const std::vector<SingleLog> singles = fit_single_logs(torque, id);
  if (singles.empty()) return {};
  const auto alike = autocovariances(singles, torque.system.joints);
  std::vector<ParameterTrend> trends(id.space.linear());
  for (int p = 0; p < id.space.linear(); ++p) {
    trends[p].name = id.space.name(p);
    trends[p].unit = id.space.unit(p);
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
  test_trends(trends);
  return trends;
}

}  // namespace faultline
