// SPDX-License-Identifier: MIT
#include "lib/identify/days/drive_limits.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/balance/rest.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/days/draft_rows.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFewestBelow = 0.3;  // share of the rows that a limit leaves to fit the robot
constexpr int kFewestBeyond = 20;     // rows beyond a limit
constexpr int kTried = 60;            // limits, at equal steps of the rank of the torque
constexpr double kNearFirst = 0.8;  // least ratio of the limit and the smallest command beyond it, either way
constexpr double kMostLeft = 0.03;  // squared deviation from the limit, over that of the excess from its mean
constexpr double kClearLimit = 20.0;   // nats over a robot without limit, from rows that are not independent
constexpr double kLimitRidge = 1e-9;   // relative, on the diagonal: columns that the motions do not separate
constexpr double kZeroColumn = 1e-30;  // on the diagonal: keeps columns of zeros regular

/// The balances of one joint that show something, by ascending absolute torque.
struct JointBalances {
  MatrixXd column;
  VectorXd torque;
};

JointBalances balances_of(const std::vector<BalanceRows>& logs, const BalanceModel& model, int j) {
  const std::vector<bool> used = rigid_columns_used(model.rigid, model.layout());
  std::vector<int> columns;
  for (std::size_t p = 0; p < used.size(); ++p)
    if (used[p]) columns.push_back(static_cast<int>(p));
  struct Place {
    double size;
    int log, row;
  };
  std::vector<Place> places;
  for (std::size_t d = 0; d < logs.size(); ++d)
    for (int k = 0; k < logs[d].rows(); ++k)
      if (!logs[d].lost[k] && !logs[d].is_silent(k, j))
        places.push_back({std::abs(logs[d].torque(k, j)), static_cast<int>(d), k});
  std::ranges::stable_sort(places, {}, &Place::size);
  JointBalances out{MatrixXd(places.size(), columns.size()), VectorXd(places.size())};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const BalanceRows& log = logs[places[i].log];
    out.column.row(static_cast<Eigen::Index>(i)) = log.column[j].row(places[i].row)(columns);
    out.torque[static_cast<Eigen::Index>(i)] = log.torque(places[i].row, j);
  }
  return out;
}

/// Sums of a least squares fit to the first rows of a joint.
struct Sums {
  MatrixXd square;
  VectorXd product;
  double torque_square = 0.0;

  void add(const JointBalances& all, Eigen::Index from, Eigen::Index to) {
    const auto x = all.column.middleRows(from, to - from);
    const auto y = all.torque.segment(from, to - from);
    square += x.transpose() * x;
    product += x.transpose() * y;
    torque_square += y.squaredNorm();
  }
  VectorXd solution() const {
    MatrixXd ridged = square;
    ridged.diagonal() *= 1.0 + kLimitRidge;
    ridged.diagonal().array() += kZeroColumn;
    return ridged.ldlt().solve(product);
  }
  double left(const VectorXd& theta) const {
    return torque_square - 2.0 * theta.dot(product) + theta.dot(square * theta);
  }
};

/// A limit, and what it explains.
struct TriedLimit {
  double torque = 0.0;  ///< N m or N
  double left = 0.0;    ///< squared residual of all rows
};

/// Returns the limit of the torque from row `begin` on, if these rows show one: the robot `below`, fitted to
/// the rows before, needs that torque there whatever is commanded. A load, in contrast, adds about the same
/// to a torque that varies. What a joint at rest needs is constant as well, so the deviation from the limit
/// counts as no smaller than the residual of the rows before.
std::optional<TriedLimit> limit_at(const JointBalances& all, const Sums& below, Eigen::Index begin) {
  const VectorXd theta = below.solution();
  const double left_below = std::max(below.left(theta), 0.0);
  const Eigen::Index beyond = all.torque.size() - begin;
  const VectorXd sign = all.torque.tail(beyond).cwiseSign();
  const VectorXd needed = (all.column.bottomRows(beyond) * theta).cwiseProduct(sign);
  // The kernels of the rows with the largest command lie beyond the limit as a whole.
  const double limit = upper_median({needed.begin() + beyond / 2, needed.end()});
  const VectorXd excess = all.torque.tail(beyond).cwiseAbs() - needed;
  const double at_limit = (needed.array() - limit).square().sum(),
               usual = left_below / static_cast<double>(begin) * static_cast<double>(beyond),
               first = std::abs(all.torque[begin]);
  const bool shows = limit > kNearFirst * first && limit * kNearFirst < first &&
                     std::max(at_limit, usual) < kMostLeft * (excess.array() - excess.mean()).square().sum();
  if (!shows) return std::nullopt;
  return TriedLimit{limit, left_below + at_limit};
}

double limit_of(const JointBalances& all) {
  const Eigen::Index rows = all.torque.size(), columns = all.column.cols();
  Eigen::Index begin = static_cast<Eigen::Index>(kFewestBelow * static_cast<double>(rows));
  if (begin <= 2 * columns || rows - begin < kFewestBeyond) return 0.0;
  Sums below{MatrixXd::Zero(columns, columns), VectorXd::Zero(columns)};
  below.add(all, 0, begin);
  std::optional<TriedLimit> best;
  const Eigen::Index step = std::max<Eigen::Index>(1, (rows - begin) / kTried);
  for (; rows - begin >= kFewestBeyond; begin += step) {
    const std::optional<TriedLimit> tried = limit_at(all, below, begin);
    if (tried && (!best || tried->left < best->left)) best = tried;
    below.add(all, begin, std::min(begin + step, rows));
  }
  if (!best) return 0.0;
  if (begin < rows) below.add(all, std::min(begin, rows), rows);
  const double none = below.left(below.solution());
  const double nats = 0.5 * static_cast<double>(rows) * elementary::log(none / best->left);
  return nats > kClearLimit ? best->torque : 0.0;
}

}  // namespace

VectorXd drive_limits(const std::vector<UniformLog>& logs, const BalanceModel& model) {
  std::vector<BalanceRows> rows;
  for (const UniformLog& log : logs) {
    rows.push_back(balance_rows(log, model.setting, model.rigid, {}));
    rows.back().silent = sticking_rows(rows.back(), model);
  }
  VectorXd out(model.joints());
  for (int j = 0; j < out.size(); ++j) out[j] = limit_of(balances_of(rows, model, j));
  return out;
}

}  // namespace faultline
