// SPDX-License-Identifier: MIT
#include "lib/residual/relation/relation_fit.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/matrix/decompositions.hpp"
#include "lib/core/statistics.hpp"
#include "lib/log/log.hpp"
#include "lib/residual/relation/relation_residual.hpp"

namespace faultline {
namespace {

constexpr int kFewestFolds = 4;      // fewer logs are cut into pieces
constexpr int kFewestRows = 20;      // rows for each weight, at least
constexpr double kRidge = 1e-11;     // regularisation, as a share of each term's power
constexpr double kBeyondSeen = 0.2;  // share of a term's range by which its learned range is widened
// For a control law on held-out rows: the part of an integrator differs between days with friction and load.
constexpr double kLeastR2 = 0.999;

constexpr int kFewestWindows = 10;      // windows in succession that healthy logs must fill for a limit
constexpr double kLeastStd = 1e-5;      // least std of a mean, of target_scale(): for logs without noise
constexpr double kOfLargestSeen = 1.5;  // least limit over the largest mean of healthy logs: a margin

/// Sums of least squares over some rows.
struct Moments {
  Eigen::MatrixXd gram;
  Eigen::VectorXd right;
  double square = 0.0, sum = 0.0;
  long long rows = 0;

  explicit Moments(int terms)
      : gram(Eigen::MatrixXd::Zero(terms, terms)), right(Eigen::VectorXd::Zero(terms)) {}

  void add(const std::vector<double>& terms, double target) {
    const Eigen::Map<const Eigen::VectorXd> x(terms.data(), static_cast<Eigen::Index>(terms.size()));
    gram.selfadjointView<Eigen::Lower>().rankUpdate(x);
    right += target * x;
    square += target * target;
    sum += target;
    ++rows;
  }
  Moments& operator+=(const Moments& other) {
    gram += other.gram, right += other.right;
    square += other.square, sum += other.sum, rows += other.rows;
    return *this;
  }
};

Moments without(const Moments& all, const Moments& part) {
  Moments rest = all;
  rest.gram -= part.gram, rest.right -= part.right;
  rest.square -= part.square, rest.sum -= part.sum, rest.rows -= part.rows;
  return rest;
}

std::vector<double> weights_of(const Moments& moments) {
  const Eigen::VectorXd power = moments.gram.diagonal();
  const Eigen::VectorXd scale = power.unaryExpr([](double p) { return p > 0.0 ? 1.0 / std::sqrt(p) : 0.0; });
  Eigen::MatrixXd scaled = Eigen::MatrixXd(moments.gram.selfadjointView<Eigen::Lower>());
  scaled = scale.asDiagonal() * scaled * scale.asDiagonal();
  for (int i = 0; i < scaled.rows(); ++i) scaled(i, i) = scale[i] > 0.0 ? scaled(i, i) + kRidge : 1.0;
  const Eigen::VectorXd solution = solve_definite(scaled, scale.cwiseProduct(moments.right));
  const Eigen::VectorXd weights = scale.cwiseProduct(solution);
  return {weights.begin(), weights.end()};
}

std::int64_t rows_of(LogSource& log) {
  std::int64_t rows = 0;
  log.rewind();
  for (Log segment; log.next(segment);) rows = segment.first_row + segment.rows();
  return rows;
}

/// Calls visit(segment, row) for the rows of a fold.
template <typename Visit>
void for_each_row(std::span<LogSource* const> logs, const Fold& fold, Visit visit) {
  LogSource& log = *logs[fold.log];
  log.rewind();
  for (Log segment; log.next(segment);)
    for (int k = 0; k < segment.rows(); ++k)
      if (segment.first_row + k >= fold.begin && segment.first_row + k < fold.end) visit(segment, k);
}

Moments moments_of(std::span<LogSource* const> logs, const Fold& fold, SignalRelation& relation) {
  Moments moments(relation.weights_needed());
  LagLine line(relation);
  for_each_row(logs, fold, [&](const Log& segment, int k) {
    if (!has_signals(segment, relation)) return;
    const double target = signals_of(segment, relation.target)[relation.joint.index()][k];
    if (!line.take(segment, k) || !std::isfinite(target)) return;
    moments.add(line.terms(), target);
    relation.low = std::min(relation.low, target);
    relation.high = std::max(relation.high, target);
    for (std::size_t i = 0; i < relation.term_low.size(); ++i) {
      relation.term_low[i] = std::min(relation.term_low[i], line.terms()[i]);
      relation.term_high[i] = std::max(relation.term_high[i], line.terms()[i]);
    }
  });
  return moments;
}

/// Statistics of residual means over windows, on held-out rows.
struct WindowMeanStats {
  explicit WindowMeanStats(std::size_t windows) : square(windows), largest(windows), count(windows) {}

  std::vector<double> square, largest;
  std::vector<long long> count;
  double residual_square = 0.0;
};

void add_window_means(std::span<LogSource* const> logs, const Fold& fold, const SignalRelation& relation,
                      WindowMeanStats& stats) {
  RelationResidual residual(relation);
  WindowedMeans means(window_rows(kRelationWindows_s, relation.period_s));
  for_each_row(logs, fold, [&](const Log& segment, int k) {
    if (!has_signals(segment, relation)) return;
    const auto sample = residual.take(segment, k);
    if (!sample) return;
    stats.residual_square += sample->residual * sample->residual;
    means.add(sample->residual, sample->time);
    for (int w = 0; w < means.full(); ++w) {
      const double mean = means.mean(w);
      stats.square[w] += mean * mean;
      stats.largest[w] = std::max(stats.largest[w], std::abs(mean));
      ++stats.count[w];
    }
  });
}

/// Number of standard deviations that a mean over a window exceeds by chance at this rate.
double stds_of(double alarms_per_hour, double window_s) {
  const double chance = alarms_per_hour * window_s / 3600.0;
  double low = 0.0, high = 20.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (normal_tail(middle) > chance ? low : high) = middle;
  }
  return high;
}

/// Returns limits of the windows that healthy logs fill; the windows share the rate of alarms.
std::vector<WindowLimit> limits_of(const WindowMeanStats& stats, const std::vector<int>& rows, double scale,
                                   double alarms_per_hour) {
  std::vector<WindowLimit> windows;
  for (std::size_t w = 0; w < stats.square.size(); ++w) {
    if (stats.count[w] < kFewestWindows * rows[w]) break;
    const double seen = std::sqrt(stats.square[w] / static_cast<double>(stats.count[w]));
    // The mean over a longer window has at least the deviation that white noise would have.
    const double white =
        w > 0 ? windows.back().std * std::sqrt(static_cast<double>(rows[w - 1]) / rows[w]) : 0.0;
    const double std = std::max({seen, white, kLeastStd * scale});
    const double stds = stds_of(alarms_per_hour / static_cast<double>(rows.size()), kRelationWindows_s[w]);
    windows.push_back({kRelationWindows_s[w], std, std::max(stds * std, kOfLargestSeen * stats.largest[w])});
  }
  return windows;
}

/// Widens the learned range of each term on either side.
void widen_terms(SignalRelation& relation) {
  for (std::size_t i = 0; i < relation.term_low.size(); ++i) {
    const double more = kBeyondSeen * (relation.term_high[i] - relation.term_low[i]);
    relation.term_low[i] -= more;
    relation.term_high[i] += more;
  }
}

}  // namespace

double middle_deviation(const SignalRelation& relation) {
  return relation.windows[std::min<std::size_t>(1, relation.windows.size() - 1)].std;
}

double target_scale(const SignalRelation& relation) {
  if (relation.kind == RelationKind::tracking) return relation.high - relation.low;
  return std::max(std::abs(relation.low), std::abs(relation.high));
}

std::vector<Fold> folds_of(std::span<LogSource* const> logs) {
  const int count = static_cast<int>(logs.size());
  const int pieces = (kFewestFolds + count - 1) / std::max(count, 1);
  std::vector<Fold> folds;
  for (int i = 0; i < count; ++i) {
    const std::int64_t rows = rows_of(*logs[i]);
    for (int p = 0; p < pieces; ++p)
      folds.push_back({i, p * rows / pieces,
                       p + 1 < pieces ? (p + 1) * rows / pieces : std::numeric_limits<std::int64_t>::max()});
  }
  return folds;
}

std::optional<SignalRelation> fitted(std::span<LogSource* const> logs, const std::vector<Fold>& folds,
                                     double alarms_per_hour, SignalRelation relation) {
  relation.low = std::numeric_limits<double>::infinity();
  relation.high = -relation.low;
  relation.term_low.assign(relation.weights_needed() - 1, relation.low);
  relation.term_high.assign(relation.weights_needed() - 1, relation.high);
  Moments all(relation.weights_needed());
  std::vector<Moments> parts;
  for (const Fold& fold : folds) all += parts.emplace_back(moments_of(logs, fold, relation));
  if (all.rows < kFewestRows * relation.weights_needed()) return std::nullopt;
  WindowMeanStats stats(std::size(kRelationWindows_s));
  for (std::size_t f = 0; f < folds.size(); ++f) {
    const Moments rest = without(all, parts[f]);
    if (rest.rows < relation.weights_needed()) continue;
    relation.weights = weights_of(rest);
    add_window_means(logs, folds[f], relation, stats);
  }
  const double variance = all.square - all.sum * all.sum / static_cast<double>(all.rows);
  if (!(variance > 0.0)) return std::nullopt;
  relation.weights = weights_of(all);
  widen_terms(relation);
  relation.r2 = 1.0 - stats.residual_square / variance;
  relation.windows = limits_of(stats, window_rows(kRelationWindows_s, relation.period_s),
                               target_scale(relation), alarms_per_hour);
  const bool follows = relation.kind != RelationKind::control_law || relation.r2 >= kLeastR2;
  if (!follows || relation.windows.empty()) return std::nullopt;
  return relation;
}

}  // namespace faultline
