// SPDX-License-Identifier: MIT
#include "lib/identify/weak_form/weak_form.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/matrix/decompositions.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr double kResting = 0.03;  // of the speed of a joint's fastest window: below, the joint rests
constexpr double kShown = 1e-6;    // of a squared column: least share from moving joints

constexpr int kRounds = 8;             // fits with new weights, at most
constexpr double kOutlierStd = 8.0;    // robust standard deviations up to which a row has its full weight
constexpr double kFormSettled = 1e-9;  // relative change of the residual's scales below which rounds end

constexpr double kDependent = 3e-3;   ///< least share of a scaled column that is independent of the others
constexpr double kNotExcited = 1e-9;  ///< rms of a column, in units of the residual: less is rounding
constexpr double kMixed = 0.03;  ///< share of a column in a dependent one beyond which both are confounded

double condition(const Eigen::MatrixXd& a) {
  if (a.cols() == 0) return 0.0;
  const Eigen::VectorXd s = singular_values(a);
  return s[0] / s[s.size() - 1];
}

std::vector<int> excited_columns(const Eigen::MatrixXd& a, const std::vector<bool>& wanted) {
  std::vector<int> listed;
  for (int c = 0; c < a.cols(); ++c)
    if (wanted[c] && a.col(c).norm() > kNotExcited * std::sqrt(static_cast<double>(a.rows())))
      listed.push_back(c);
  return listed;
}

/// Selects those of the `listed` columns, here scaled, that are no mixture of others.
void select_independent(const Eigen::MatrixXd& scaled, const std::vector<int>& listed, ColumnSelection& out) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
  const Eigen::MatrixXd r = qr.matrixR().topRows(scaled.cols()).triangularView<Eigen::Upper>();
  const auto order = qr.colsPermutation().indices();
  int rank = 0;
  while (rank < scaled.cols() && std::abs(r(rank, rank)) > kDependent) ++rank;
  for (int i = 0; i < rank; ++i) {
    out.columns.push_back(listed[order[i]]);
    out.confounded[listed[order[i]]] = false;
  }
  if (rank < scaled.cols()) {  // the others are mixtures of those
    const Eigen::MatrixXd mixture = r.topLeftCorner(rank, rank)
                                        .triangularView<Eigen::Upper>()
                                        .solve(r.topRightCorner(rank, scaled.cols() - rank));
    for (int i = 0; i < rank; ++i)
      if (mixture.row(i).cwiseAbs().maxCoeff() > kMixed) out.confounded[listed[order[i]]] = true;
  }
  std::sort(out.columns.begin(), out.columns.end());
}

/// Returns those of the `listed` columns that were chosen and have an index below `rigid`.
Eigen::MatrixXd base_columns(const Eigen::MatrixXd& scaled, const std::vector<int>& listed,
                             const std::vector<int>& chosen, int rigid) {
  std::vector<int> base;
  for (std::size_t i = 0; i < listed.size(); ++i)
    if (listed[i] < rigid && std::binary_search(chosen.begin(), chosen.end(), listed[i]))
      base.push_back(static_cast<int>(i));
  return scaled(Eigen::all, base);
}

/// Returns 1.4826 times the median |residual| of a joint's used rows; at least 1e-12 and torque rounding.
Eigen::VectorXd robust_scales(const WeakSystem& s, const Eigen::VectorXd& r) {
  std::vector<std::vector<double>> size(s.joints);
  Eigen::VectorXd least = Eigen::VectorXd::Constant(s.joints, 1e-12);
  for (Eigen::Index k = 0; k < r.size(); ++k) {
    least[s.joint[k]] = std::max(least[s.joint[k]], 1e-12 * std::abs(s.y[k]));
    if (s.use[k] > 0.0) size[s.joint[k]].push_back(std::abs(r[k]));
  }
  Eigen::VectorXd scale(s.joints);
  for (int j = 0; j < s.joints; ++j)
    scale[j] = size[j].empty() ? 1.0 : std::max(1.4826 * upper_median_of(size[j]), least[j]);
  return scale;
}

/// Returns 1 up to the residuals of a slightly wrong model; beyond, the weight falls with the square.
double outlier_weight(double r) {
  const double u = std::abs(r) / kOutlierStd;
  return u > 1.0 ? 1.0 / (u * u) : 1.0;
}

/// Returns the jackknife covariance over the blocks: the change of the fit without one of them, squared and
/// summed. Unlike the usual sandwich it is not too narrow if blocks are few (Bell and McCaffrey 2002).
Eigen::MatrixXd jackknife(const WeakSystem& s, const Eigen::MatrixXd& a, const Eigen::VectorXd& weight,
                          const Eigen::VectorXd& r) {
  const Eigen::Index m = a.cols();
  std::vector<std::vector<Eigen::Index>> rows(s.blocks);
  for (Eigen::Index k = 0; k < a.rows(); ++k) rows[s.block[k]].push_back(k);
  const Eigen::MatrixXd normal = a.transpose() * weight.asDiagonal() * a;
  Eigen::MatrixXd steps = Eigen::MatrixXd::Zero(m, s.blocks);
  for (int block = 0; block < s.blocks; ++block) {
    const Eigen::MatrixXd own = a(rows[block], Eigen::all);
    const Eigen::VectorXd own_weight = weight(rows[block]);
    const Eigen::VectorXd gradient = own.transpose() * own_weight.cwiseProduct(r(rows[block]));
    const Eigen::VectorXd step =
        solve_definite(normal - own.transpose() * own_weight.asDiagonal() * own, gradient);
    steps.col(block) = step.allFinite() ? step : solve_definite(normal, gradient);
  }
  const double blocks = s.blocks;
  steps.colwise() -= Eigen::VectorXd(steps.rowwise().mean());
  return steps * steps.transpose() * ((blocks - 1.0) / blocks);
}

void judge(const WeakSystem& s, const Eigen::VectorXd& robust, WeakFit& fit) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(s.joints), mean = sum, spread = sum, count = sum;
  for (Eigen::Index k = 0; k < s.y.size(); ++k)
    if (robust[k] > 0.0) mean[s.joint[k]] += s.y[k], count[s.joint[k]] += 1.0;
  mean = mean.cwiseQuotient(count.cwiseMax(1.0));
  for (Eigen::Index k = 0; k < s.y.size(); ++k)
    if (robust[k] > 0.0) {
      const int j = s.joint[k];
      sum[j] += fit.residual[k] * fit.residual[k];
      spread[j] += (s.y[k] - mean[j]) * (s.y[k] - mean[j]);
    }
  for (int j = 0; j < s.joints; ++j) {
    fit.residual_rms.push_back(std::sqrt(sum[j] / std::max(count[j], 1.0)));
    fit.r2.push_back(spread[j] > 0.0 ? 1.0 - sum[j] / spread[j] : 0.0);
  }
}

}  // namespace

double seconds_covered(const WeakWindows& windows) {
  std::set<std::pair<int, long>> seconds;
  for (const WeakWindow& w : windows.all()) seconds.emplace(w.log, static_cast<long>(std::floor(w.time_s)));
  return static_cast<double>(seconds.size());
}

double residual_block_s(double total_s, double parameters) {
  // Bounds of a block's length, and the number of blocks for each parameter.
  constexpr double kLongest_s = 1.0, kShortest_s = 0.1, kBlocksPerParameter = 5.0;
  return std::clamp(total_s / (kBlocksPerParameter * parameters), kShortest_s, kLongest_s);
}

std::vector<bool> moving_windows(const WeakSets& windows, int set, int j) {
  const std::vector<WeakWindow>& all = windows.sets[set].all();
  if (has_joint(windows.still, Joint::at(j))) return std::vector<bool>(all.size(), false);
  double fastest = 0.0;
  for (const WeakWindow& w : all) fastest = std::max(fastest, w.speed[j]);
  std::vector<bool> moving;
  for (const WeakWindow& w : all) moving.push_back(w.speed[j] >= kResting * fastest);
  return moving;
}

Eigen::RowVectorXd linear_row(const ParameterSpace& space, const WeakWindow& w, int j, int width, int bend) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(space.linear());
  row.head(space.rigid()) = w.base.row(j);
  row[space.viscous(j)] = w.viscous[j];
  row[space.coulomb(j)] = w.coulomb(j, width);
  row[space.offset(j)] = 1.0;
  row[space.bend(j)] = w.coulomb(j, bend);
  row[space.skew(j)] = w.skew[j];
  row.segment(space.extra_begin(), w.extra.cols()) = w.extra.row(j);
  return row;
}

WeakSystem assemble(const WeakSets& windows, const WeakChoice& choice) {
  const ParameterSpace& space = windows.space;
  WeakSystem s;
  s.joints = space.joints();
  s.width.resize(s.joints);
  Eigen::Index rows = 0;
  for (int j = 0; j < s.joints; ++j) {
    rows += static_cast<Eigen::Index>(windows.sets[choice.set[j]].all().size());
    s.width[j] = elementary::log(weak_width(space, j, choice.width[j]));
  }
  s.a.resize(rows, space.linear());
  s.y.resize(rows);
  s.use.setOnes(rows);
  Eigen::Index row = 0;
  for (int j = 0; j < s.joints; ++j) {
    const WeakWindows& set = windows.sets[choice.set[j]];
    const std::vector<bool> moving = moving_windows(windows, choice.set[j], j);
    const int at = choice.shift[j] - windows.shifts.first, before = std::max(at - 1, 0);
    for (std::size_t k = 0; k < set.all().size(); ++k, ++row) {
      const WeakWindow& w = set.all()[k];
      s.a.row(row) = linear_row(space, w, j, choice.width[j], choice.bend[j]);
      s.a(row, space.timing()) = w.torque(j, at) - w.torque(j, before);
      s.y[row] = w.torque(j, at);
      if (!moving[k]) s.use[row] = 0.0;
      s.joint.push_back(j);
      s.log.push_back(w.log);
      s.time_s.push_back(w.time_s);
    }
  }
  return with_blocks(std::move(s), seconds_covered(windows.sets[0]));
}

WeakSystem with_blocks(WeakSystem s, double total_s) {
  const double block_s = residual_block_s(total_s, static_cast<double>(s.a.cols()));
  std::map<std::pair<int, long>, int> blocks;
  for (std::size_t k = 0; k < s.log.size(); ++k) {
    const std::pair<int, long> part{s.log[k], static_cast<long>(std::floor(s.time_s[k] / block_s))};
    s.block.push_back(blocks.emplace(part, static_cast<int>(blocks.size())).first->second);
  }
  s.blocks = static_cast<int>(blocks.size());
  return s;
}

bool is_shown_at_rest(const WeakSystem& system, int p, const std::vector<Joint>& still) {
  double all = 0.0, moving = 0.0;
  for (Eigen::Index k = 0; k < system.a.rows(); ++k) {
    const double square = system.a(k, p) * system.a(k, p);
    all += square;
    if (!has_joint(still, Joint::at(system.joint[k]))) moving += square;
  }
  return moving <= kShown * all;
}

ColumnSelection select_columns(const Eigen::MatrixXd& a, const std::vector<bool>& wanted, int rigid) {
  ColumnSelection out;
  out.confounded.assign(a.cols(), true);
  const std::vector<int> listed = excited_columns(a, wanted);
  if (listed.empty()) return out;
  Eigen::MatrixXd scaled(a.rows(), listed.size());
  for (std::size_t i = 0; i < listed.size(); ++i) scaled.col(i) = a.col(listed[i]).normalized();
  select_independent(scaled, listed, out);
  out.condition_number = condition(base_columns(scaled, listed, out.columns, rigid));
  return out;
}

WeakFit fit_weak_form(const WeakSystem& s, const ParameterSpace& space, const Eigen::VectorXd& start,
                      const std::vector<bool>& wanted) {
  const int linear = space.linear();
  WeakFit fit;
  fit.windows = static_cast<int>(s.y.size()) / std::max(s.joints, 1);
  fit.parameters = start;
  for (int j = 0; j < s.joints; ++j) fit.parameters[space.log_width(j)] = s.width[j];
  Eigen::VectorXd robust = s.use, scale = robust_scales(s, s.y);
  fit.weight.resize(s.y.size());
  ColumnSelection selection;
  for (int round = 0; round < kRounds; ++round) {
    for (Eigen::Index k = 0; k < s.y.size(); ++k)
      fit.weight[k] = robust[k] / (scale[s.joint[k]] * scale[s.joint[k]]);
    const Eigen::VectorXd root = fit.weight.cwiseSqrt();
    const Eigen::MatrixXd a = root.asDiagonal() * s.a;
    if (round < 2) selection = select_columns(a, wanted, space.rigid());
    Eigen::VectorXd known = start.head(linear);
    for (int c : selection.columns) known[c] = 0.0;
    const Eigen::VectorXd x = Eigen::MatrixXd(a(Eigen::all, selection.columns))
                                  .householderQr()
                                  .solve(root.asDiagonal() * (s.y - s.a * known));
    fit.parameters.head(linear) = known;
    for (std::size_t i = 0; i < selection.columns.size(); ++i) fit.parameters[selection.columns[i]] = x[i];
    fit.residual = s.y - s.a * fit.parameters.head(linear);
    const Eigen::VectorXd next = robust_scales(s, fit.residual);
    const bool settled = ((next - scale).array().abs() <= kFormSettled * scale.array()).all();
    scale = next;
    for (Eigen::Index k = 0; k < s.y.size(); ++k)
      robust[k] = s.use[k] * outlier_weight(fit.residual[k] / scale[s.joint[k]]);
    if (settled && round > 1) break;
  }
  fit.condition_number = selection.condition_number;
  fit.confounded = selection.confounded;
  fit.confounded.resize(space.count(), true);
  fit.free.assign(space.count(), false);
  for (int c : selection.columns) fit.free[c] = true;
  const Eigen::MatrixXd cov = jackknife(s, s.a(Eigen::all, selection.columns), fit.weight, fit.residual);
  fit.covariance.setZero(space.count(), space.count());
  for (std::size_t i = 0; i < selection.columns.size(); ++i)
    for (std::size_t k = 0; k < selection.columns.size(); ++k)
      fit.covariance(selection.columns[i], selection.columns[k]) = cov(i, k);
  judge(s, robust, fit);
  return fit;
}

}  // namespace faultline
