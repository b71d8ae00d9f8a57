// SPDX-License-Identifier: MIT
#include "lib/residual/relation/learn_relations.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/log/log_channels.hpp"
#include "lib/residual/relation/lag_line.hpp"
#include "lib/residual/relation/relation_residual.hpp"
#include "lib/residual/relation/windowed_means.hpp"

namespace faultline {
namespace {

constexpr double kActuatorMemory_s = 0.03;  // of a current loop and its filter
constexpr double kLawMemory_s = 0.01;       // of a controller's filters
constexpr int kFewestLags = 2, kMostLags = 12;

constexpr int kFewestFolds = 4;      // fewer logs are cut into pieces
constexpr int kFewestRows = 20;      // for each weight
constexpr double kRidge = 1e-11;     // of each term's power
constexpr double kBeyondSeen = 0.2;  // of an input's range
constexpr double kLeastR2 = 0.9;     // of rows left out

constexpr double kStdsToLimit = 6.0;    // by chance once in some hundred hours
constexpr double kLeastStd = 1e-5;      // of the largest torque: of logs without noise
constexpr double kOfLargestSeen = 1.5;  // and what healthy logs reached, with a margin
constexpr double kBlindShare =
    0.25;  // of the largest torque: a limit beyond it, in the middle window, tells little

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
  const Eigen::VectorXd solution = scaled.ldlt().solve(scale.cwiseProduct(moments.right));
  const Eigen::VectorXd weights = scale.cwiseProduct(solution);
  return {weights.begin(), weights.end()};
}

/// A stretch of a healthy log that is left out together.
struct Fold {
  int log = 0;
  std::int64_t begin = 0, end = std::numeric_limits<std::int64_t>::max();  ///< rows
};

std::int64_t rows_of(LogSource& log) {
  std::int64_t rows = 0;
  log.rewind();
  for (Log segment; log.next(segment);) rows = segment.first_row + segment.rows();
  return rows;
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
    const double target = signals_of(segment, relation.target)[relation.joint][k];
    if (!line.take(segment, k) || !std::isfinite(target)) return;
    moments.add(line.terms(), target);
    relation.low = std::min(relation.low, target);
    relation.high = std::max(relation.high, target);
    for (std::size_t i = 0; i < relation.input_low.size(); ++i) {
      relation.input_low[i] = std::min(relation.input_low[i], line.value(static_cast<int>(i)));
      relation.input_high[i] = std::max(relation.input_high[i], line.value(static_cast<int>(i)));
    }
  });
  return moments;
}

/// How means over windows stray, over rows that were left out.
struct Straying {
  explicit Straying(std::size_t windows) : square(windows), largest(windows), count(windows) {}

  std::vector<double> square, largest;
  std::vector<long long> count;
  double residual_square = 0.0;
};

void add_straying(std::span<LogSource* const> logs, const Fold& fold, const SignalRelation& relation,
                  Straying& straying) {
  RelationResidual residual(relation);
  WindowedMeans means(window_rows(kRelationWindows_s, relation.period_s));
  for_each_row(logs, fold, [&](const Log& segment, int k) {
    if (!has_signals(segment, relation)) return;
    const auto sample = residual.take(segment, k);
    if (!sample) return means.restart();
    straying.residual_square += sample->residual * sample->residual;
    means.add(sample->residual);
    for (int w = 0; w < means.full(); ++w) {
      const double mean = means.mean(w);
      straying.square[w] += mean * mean;
      straying.largest[w] = std::max(straying.largest[w], std::abs(mean));
      ++straying.count[w];
    }
  });
}

double largest_target(const SignalRelation& relation) {
  return std::max(std::abs(relation.low), std::abs(relation.high));
}

/// Limits of the windows that healthy logs fill.
std::vector<WindowLimit> limits_of(const Straying& straying, double largest) {
  std::vector<WindowLimit> windows;
  for (std::size_t w = 0; w < straying.square.size(); ++w) {
    if (straying.count[w] == 0) break;
    const double seen = std::sqrt(straying.square[w] / static_cast<double>(straying.count[w]));
    const double std = std::max(seen, kLeastStd * largest);
    windows.push_back(
        {kRelationWindows_s[w], std, std::max(kStdsToLimit * std, kOfLargestSeen * straying.largest[w])});
  }
  return windows;
}

/// Motions a little beyond what was seen are not another world.
void widen_inputs(SignalRelation& relation) {
  for (std::size_t i = 0; i < relation.input_low.size(); ++i) {
    const double more = kBeyondSeen * (relation.input_high[i] - relation.input_low[i]);
    relation.input_low[i] -= more;
    relation.input_high[i] += more;
  }
}

/// Fits the relation; false where it does not hold.
bool fit(std::span<LogSource* const> logs, const std::vector<Fold>& folds, SignalRelation& relation) {
  relation.low = std::numeric_limits<double>::infinity();
  relation.high = -relation.low;
  if (relation.kind == RelationKind::control_law) {
    relation.input_low.assign(relation.inputs.size(), relation.low);
    relation.input_high.assign(relation.inputs.size(), relation.high);
  }
  Moments all(relation.weights_needed());
  std::vector<Moments> parts;
  for (const Fold& fold : folds) all += parts.emplace_back(moments_of(logs, fold, relation));
  if (all.rows < kFewestRows * relation.weights_needed()) return false;
  Straying straying(std::size(kRelationWindows_s));
  for (std::size_t f = 0; f < folds.size(); ++f) {
    const Moments rest = without(all, parts[f]);
    if (rest.rows < relation.weights_needed()) continue;
    SignalRelation left_out = relation;
    left_out.weights = weights_of(rest);
    add_straying(logs, folds[f], left_out, straying);
  }
  const double variance = all.square - all.sum * all.sum / static_cast<double>(all.rows);
  if (!(variance > 0.0)) return false;
  relation.weights = weights_of(all);
  widen_inputs(relation);
  relation.r2 = 1.0 - straying.residual_square / variance;
  const double largest = largest_target(relation);
  relation.windows = limits_of(straying, largest);
  return relation.r2 >= kLeastR2 && !relation.windows.empty() &&
         relation.windows[relation.windows.size() / 2].limit <= kBlindShare * largest;
}

int lags_of(double memory_s, double period_s) {
  return std::clamp(static_cast<int>(std::ceil(memory_s / period_s)), kFewestLags, kMostLags);
}

/// What of a joint may follow what, by the signals that the log has; without targets that are not there.
std::vector<SignalRelation> candidates(const Log& log, const RelationOptions& options) {
  const auto commanded = commanded_torque(log, options.torque_is_commanded);
  const auto measured = measured_torque(log, options.torque_is_commanded);
  std::vector<Quantity> read;  // by the controller
  for (const Quantity quantity : {Quantity::q_ref, Quantity::dq_ref, Quantity::q, Quantity::dq})
    if (!signals_of(log, quantity).empty()) read.push_back(quantity);
  std::vector<SignalRelation> out;
  for (int j = 0; j < log.joints(); ++j) {
    if (commanded && measured)
      out.push_back({.kind = RelationKind::actuator,
                     .joint = j,
                     .target = *measured,
                     .inputs = {*commanded},
                     .lags = lags_of(kActuatorMemory_s, options.period_s)});
    if (!log.q_ref.empty() && (commanded || measured))
      out.push_back({.kind = RelationKind::control_law,
                     .joint = j,
                     .target = commanded ? *commanded : *measured,
                     .inputs = read,
                     .lags = lags_of(kLawMemory_s, options.period_s)});
  }
  for (SignalRelation& relation : out) relation.period_s = options.period_s;
  return out;
}

std::vector<SignalRelation> candidates(LogSource& log, const RelationOptions& options) {
  Log first;
  log.rewind();
  return log.next(first) ? candidates(first, options) : std::vector<SignalRelation>{};
}

}  // namespace

std::vector<SignalRelation> learn_relations(std::span<LogSource* const> healthy,
                                            const RelationOptions& options) {
  if (healthy.empty() || !(options.period_s > 0.0)) return {};
  std::vector<SignalRelation> relations = candidates(*healthy.front(), options);
  if (relations.empty()) return {};
  const std::vector<Fold> folds = folds_of(healthy);
  std::erase_if(relations, [&](SignalRelation& relation) { return !fit(healthy, folds, relation); });
  for (SignalRelation& relation : relations) {
    if (relation.kind != RelationKind::actuator) continue;
    relation.offset_range = options.torque_offset * largest_target(relation);
    relation.gain_range = options.torque_gain;
  }
  return relations;
}

}  // namespace faultline
