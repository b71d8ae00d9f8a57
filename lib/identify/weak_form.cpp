// SPDX-License-Identifier: MIT
#include "lib/identify/weak_form.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "lib/core/statistics.hpp"
#include "lib/identify/column_selection.hpp"
#include "lib/identify/weak_system.hpp"

namespace faultline {
namespace {

constexpr int kRounds = 8;
constexpr double kOutlierStd = 8.0;
constexpr double kClearlyBetter = 1.3;  ///< Coulomb friction is sharp unless the logs strongly say otherwise
constexpr double kResting = 0.03;       ///< of a joint's fastest window

/// 1.4826 times the median absolute value of every n-th entry from `joint`.
double robust_scale(const Eigen::VectorXd& r, int joint, int n) {
  std::vector<double> size;
  for (Eigen::Index k = joint; k < r.size(); k += n) size.push_back(std::abs(r[k]));
  if (size.empty()) return 1.0;
  return 1.4826 * upper_median_of(size);
}

Eigen::MatrixXd pick(const Eigen::MatrixXd& a, const std::vector<int>& columns) {
  Eigen::MatrixXd out(a.rows(), columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) out.col(i) = a.col(columns[i]);
  return out;
}

/// Full weight for all that a model a little wrong may leave; beyond, falling with the square.
double outlier_weight(double r) {
  const double u = std::abs(r) / kOutlierStd;
  return u > 1.0 ? 1.0 / (u * u) : 1.0;
}

/// (A^T W A)^-1 (sum over blocks of g g^T) (A^T W A)^-1, g the weighted gradient of a block.
Eigen::MatrixXd sandwich(const Eigen::MatrixXd& a, const Eigen::VectorXd& weight, const Eigen::VectorXd& r,
                         const std::vector<int>& block) {
  const Eigen::Index m = a.cols();
  Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(m);
  for (Eigen::Index k = 0; k < a.rows(); ++k) {
    if (k > 0 && block[k] != block[k - 1]) {
      meat += g * g.transpose();
      g.setZero();
    }
    g += weight[k] * r[k] * a.row(k).transpose();
  }
  meat += g * g.transpose();
  const Eigen::MatrixXd bread =
      (a.transpose() * weight.asDiagonal() * a).ldlt().solve(Eigen::MatrixXd::Identity(m, m));
  const double blocks = block.empty() ? 1.0 : block.back() + 1.0;
  return bread * meat * bread * std::max(1.0, blocks / std::max(1.0, blocks - static_cast<double>(m)));
}

void judge(const WeakSystem& s, const Eigen::VectorXd& residual, const Eigen::VectorXd& robust,
           WeakFit& fit) {
  for (int j = 0; j < s.joints; ++j) {
    double sum = 0.0, mean = 0.0, spread = 0.0, count = 0.0;
    for (Eigen::Index k = j; k < s.y.size(); k += s.joints)
      if (robust[k] > 0.0) mean += s.y[k], ++count;
    mean /= std::max(count, 1.0);
    for (Eigen::Index k = j; k < s.y.size(); k += s.joints)
      if (robust[k] > 0.0) {
        sum += residual[k] * residual[k];
        spread += (s.y[k] - mean) * (s.y[k] - mean);
      }
    fit.residual_rms.push_back(std::sqrt(sum / std::max(count, 1.0)));
    fit.r2.push_back(spread > 0.0 ? 1.0 - sum / spread : 0.0);
  }
}

WeakFit fit_system(const WeakSystem& s, const WeakWindows& windows, const Eigen::VectorXd& start,
                   const std::vector<bool>& wanted) {
  const int linear = windows.space().linear();
  WeakFit fit;
  fit.windows = static_cast<int>(windows.all().size());
  fit.parameters = start;
  for (int j = 0; j < s.joints; ++j)
    fit.parameters[windows.space().log_width(j)] =
        std::log(weak_width(windows.space(), j, nearest_width(windows.space(), start, j)));
  Eigen::VectorXd row_weight = Eigen::VectorXd::Ones(s.y.size()), robust = s.use, residual = s.y;
  for (int j = 0; j < s.joints; ++j) {
    const double scale = std::max(robust_scale(s.y, j, s.joints), 1e-9);
    for (Eigen::Index k = j; k < s.y.size(); k += s.joints) row_weight[k] = 1.0 / (scale * scale);
  }
  ColumnSelection selection;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::VectorXd root = (row_weight.array() * robust.array()).sqrt();
    const Eigen::MatrixXd a = root.asDiagonal() * s.a;
    if (round < 2) selection = select_columns(a, wanted, windows.space().rigid());
    Eigen::VectorXd known = start.head(linear);
    for (int c : selection.columns) known[c] = 0.0;
    const Eigen::MatrixXd free = pick(a, selection.columns);
    const Eigen::VectorXd x = free.householderQr().solve(root.asDiagonal() * (s.y - s.a * known));
    fit.parameters.head(linear) = known;
    for (std::size_t i = 0; i < selection.columns.size(); ++i) fit.parameters[selection.columns[i]] = x[i];
    residual = s.y - s.a * fit.parameters.head(linear);
    for (int j = 0; j < s.joints; ++j) {
      const double scale = std::max(robust_scale(residual, j, s.joints), 1e-12);
      for (Eigen::Index k = j; k < s.y.size(); k += s.joints) {
        row_weight[k] = 1.0 / (scale * scale);
        robust[k] = s.use[k] * outlier_weight(residual[k] / scale);
      }
    }
  }
  fit.condition_number = selection.condition_number;
  fit.confounded = selection.confounded;
  fit.confounded.resize(windows.space().count(), true);
  fit.free.assign(windows.space().count(), false);
  for (int c : selection.columns) fit.free[c] = true;
  const Eigen::MatrixXd cov =
      sandwich(pick(s.a, selection.columns), row_weight.cwiseProduct(robust), residual, s.block);
  fit.covariance.setZero(windows.space().count(), windows.space().count());
  for (std::size_t i = 0; i < selection.columns.size(); ++i)
    for (std::size_t k = 0; k < selection.columns.size(); ++k)
      fit.covariance(selection.columns[i], selection.columns[k]) = cov(i, k);
  judge(s, residual, robust, fit);
  return fit;
}

WeakFit fit_moving(const WeakWindows& windows, const Eigen::VectorXd& start,
                   const std::vector<bool>& wanted) {
  WeakSystem s = assemble(windows, start);
  const auto& all = windows.all();
  Eigen::VectorXd fastest = Eigen::VectorXd::Zero(s.joints);
  for (const WeakWindow& w : all) fastest = fastest.cwiseMax(w.speed);
  for (std::size_t k = 0; k < all.size(); ++k)
    for (int j = 0; j < s.joints; ++j)
      if (all[k].speed[j] < kResting * fastest[j]) s.use[static_cast<Eigen::Index>(k) * s.joints + j] = 0.0;
  return fit_system(s, windows, start, wanted);
}

}  // namespace

WeakFit fit_weak_form(const WeakWindows& windows, const Eigen::VectorXd& start,
                      const std::vector<bool>& wanted) {
  return fit_system(assemble(windows, start), windows, start, wanted);
}

WeakFit fit_weak_form_and_width(const WeakWindows& windows, const Eigen::VectorXd& start,
                                const std::vector<bool>& wanted) {
  const ParameterSpace& space = windows.space();
  Eigen::VectorXd sharp = start;
  for (int j = 0; j < space.joints(); ++j) sharp[space.log_width(j)] = std::log(weak_width(space, j, 0));
  WeakFit best = fit_moving(windows, sharp, wanted);
  for (int j = 0; j < space.joints(); ++j)
    for (int k = 1; k < kWidths; ++k) {
      Eigen::VectorXd tried = best.parameters;
      tried[space.log_width(j)] = std::log(weak_width(space, j, k));
      WeakFit fit = fit_moving(windows, tried, wanted);
      if (kClearlyBetter * fit.residual_rms[j] < best.residual_rms[j]) best = std::move(fit);
    }
  return best;
}

}  // namespace faultline
