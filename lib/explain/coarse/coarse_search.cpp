// SPDX-License-Identifier: MIT
#include "lib/explain/coarse/coarse_search.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "lib/balance/regress.hpp"
#include "lib/explain/hypothesis.hpp"
#include "lib/robot/payload.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array<double, 3> kBlow_s = {0.05, 0.15, 0.4};  // lengths of a collision that are tried
constexpr double kOnsetStep_s = 0.05;                         // between two onsets at least
constexpr double kTolerated = 0.002;                          // share of each state: error of a linear column
constexpr double kWindow_s = 6.0;                             // of the log after an onset that are evaluated
constexpr int kFewestWindow = 60;                             // samples of this window, at least
constexpr double kRoughStep_s = 1.0;                          // between two onsets of the rough search
constexpr double kStrike_s = 0.5, kSigmasOfStrike = 5.0;      // s of residuals; excess in standard deviations
constexpr int kFewestOfStrike = 4;                            // samples of these residuals, at least
constexpr double kWorthASecond = 2.0;    // nats from which a second onset of a kind and joint is kept
constexpr double kStrikes = 10.0;        // mean square of the innovations of a sample that noise never has
constexpr std::size_t kOnsetsTried = 3;  // onsets of the best candidates that are kept
constexpr double kWrongWay = -9.0;       // score in nats of a negative loss or payload, which is impossible

/// Successive columns of one kind and joint.
struct Group {
  FaultKind kind = FaultKind::none;
  Joint joint{};
  double duration_s = 0.0;
  Eigen::Index begin = 0;  ///< first column
  VectorXd std;            ///< of the size of each
};

/// All columns that are tried: those of numbers (numbers x columns), then those of measurements.
struct Catalogue {
  MatrixXd direction;                ///< numbers x columns; zero for measurements
  std::vector<int> length;           ///< by column, intervals; 0: to the end of the log
  Eigen::Index bias = 0, drift = 0;  ///< first column of these kinds, which have one for each joint
  std::vector<Group> groups;
};

Catalogue catalogue(const CoarseLog& log) {
  const OneStepModel& m = *log.model;
  const int n = log.joints();
  Catalogue out;
  out.direction.resize(m.layout().count(), 0);
  const auto add = [&](FaultKind kind, Joint joint, double duration_s = 0.0) {
    const MatrixXd direction = fault_directions(m, kind, joint).direction;
    Group group{kind, joint, duration_s, out.direction.cols(), prior_of_sizes(m, kind, joint)};
    out.direction.conservativeResize(Eigen::NoChange, group.begin + group.std.size());
    if (direction.size() > 0)
      out.direction.rightCols(group.std.size()) = direction;
    else
      out.direction.rightCols(group.std.size()).setZero();
    out.length.resize(out.direction.cols(), static_cast<int>(std::lround(duration_s / log.period_s())));
    out.groups.push_back(std::move(group));
  };
  for (const FaultKind kind :
       {FaultKind::torque_loss, FaultKind::friction_increase, FaultKind::torque_sensor_error})
    for (int j = 0; j < n; ++j) add(kind, Joint::at(j));
  for (const Joint link : payload_links(m.body.rigid().chain)) add(FaultKind::payload_change, link);
  for (const double length : kBlow_s)
    add(FaultKind::collision, Joint::at(n - 1),
        std::max(1.0, std::round(length / log.period_s())) * log.period_s());
  out.bias = out.direction.cols();
  for (int j = 0; j < n; ++j) add(FaultKind::sensor_bias, Joint::at(j));
  out.drift = out.direction.cols();
  for (int j = 0; j < n; ++j) add(FaultKind::sensor_drift, Joint::at(j));
  return out;
}

/// The healthy filter of the search with the regression of the day's effects.
struct Base {
  Innovations filter;
  MatrixXd day;         ///< whitened columns of the day: rows x effects
  MatrixXd covariance;  ///< of its effects
  VectorXd row;         ///< whitened rows
  VectorXd left;        ///< the same without the effects of the day
};

Base base_of(const CoarseLog& log, double tolerated_share) {
  const OneStepModel& m = *log.model;
  FilterInput in;
  in.column = log.healthy_steps.columns(log.day, MatrixXd(log.day.rows(), 0));
  in.process = process_covariance(log.healthy_steps, m.layout(), tolerated_force(log, tolerated_share));
  in.reading = log.read - log.about;
  in.variance = log.variance.colwise() + tolerated_variance(m, tolerated_share);
  Base out;
  out.filter = innovations(log.healthy_steps, in);
  const Eigen::Map<const VectorXd> keep(log.keep.data(), log.keep.size());
  out.day = keep.asDiagonal() * out.filter.white.rightCols(log.day.cols());
  out.row = keep.cwiseProduct(out.filter.white.col(0));
  MatrixXd a = out.day.transpose() * out.day;
  a.diagonal() += m.day_variance.cwiseInverse();
  out.covariance = a.llt().solve(MatrixXd::Identity(a.rows(), a.cols()));
  out.left = out.row - out.day * (out.covariance * (out.day.transpose() * out.row));
  return out;
}

/// Normal equations of all columns over a window from one onset on, without the effects of the day.
struct OnsetSums {
  MatrixXd square;
  VectorXd vector;
};

OnsetSums sums_from(const CoarseLog& log, const Base& base, const Catalogue& all, const MatrixXd& column,
                    int from, int window) {
  const int width = static_cast<int>(all.length.size()), states = log.healthy_steps.states;
  const int end = std::min(log.samples(), from + window), rows = states * (end - from);
  // Blocks before the onset are never read.
  MatrixXd pulse(states, width * log.healthy_steps.intervals), read(states, width * log.samples());
  pulse.middleCols(width * from, width * (std::min(end, log.healthy_steps.intervals) - from)).setZero();
  read.middleCols(width * from, width * (end - from)).setZero();
  for (int k = from; k < std::min(end, log.healthy_steps.intervals); ++k)
    for (int c = 0; c < width; ++c)
      if (all.length[c] == 0 || k < from + all.length[c])
        pulse.col(k * width + c) = column.col(k * width + c);
  for (int k = from; k < end; ++k)
    for (int j = 0; j < log.joints(); ++j) {
      read(j, k * width + all.bias + j) = 1.0;
      read(j, k * width + all.drift + j) = (k - from) * log.period_s();
      read(log.joints() + j, k * width + all.drift + j) = 1.0;
    }
  const Eigen::Map<const VectorXd> keep(log.keep.data(), log.keep.size());
  const MatrixXd x = keep.segment(states * from, rows).asDiagonal() *
                     white_columns(log.healthy_steps, base.filter, pulse, read, width, from, end);
  const MatrixXd cross = x.transpose() * base.day.middleRows(states * from, rows);
  return {x.transpose() * x - cross * base.covariance * cross.transpose(),
          x.transpose() * base.left.segment(states * from, rows)};
}

CoarseCandidate candidate(const CoarseLog& log, const Group& group, const OnsetSums& sums, int sample) {
  const Eigen::Index begin = group.begin, sizes = group.std.size();
  const Regression fit =
      regress({sums.square.block(begin, begin, sizes, sizes), sums.vector.segment(begin, sizes)},
              group.std.cwiseAbs2().cwiseInverse());
  CoarseCandidate out{{group.kind, group.joint, log.time_s(sample), group.duration_s, fit.estimate},
                      sample,
                      fit.log_likelihood};
  const bool positive = group.kind == FaultKind::torque_loss || group.kind == FaultKind::payload_change;
  if (positive && out.guess.start[0] < 0.0) out.score = kWrongWay;
  return out;
}

/// Adds the two best of a group that lie apart to `out`.
void keep_best(std::vector<CoarseCandidate> group, int apart, std::vector<CoarseCandidate>& out) {
  std::ranges::stable_sort(group, std::ranges::greater{}, &CoarseCandidate::score);
  const CoarseCandidate* first = nullptr;
  for (const CoarseCandidate& c : group) {
    if (first == nullptr) {
      first = &c;
      out.push_back(c);
    } else if (c.score >= kWorthASecond && std::abs(c.sample - first->sample) >= apart) {
      out.push_back(c);
      return;
    }
  }
}

/// Returns the first sample that no noise explains, with the effects of the day estimated from the samples
/// before it: a fault biases those of the whole log.
std::optional<int> strike_of(const CoarseLog& log, const Base& base) {
  const int states = log.healthy_steps.states;
  RecursiveRegression day(log.model->day_variance.cwiseInverse());
  std::vector<int> effects(base.day.cols());
  std::iota(effects.begin(), effects.end(), 0);
  for (int k = 0; k < log.samples(); ++k) {
    const double before = day.square();
    for (int i = k * states; i < (k + 1) * states; ++i)
      day.add(base.day.row(i).transpose(), effects, base.row[i]);
    if (k >= log.first_onset() && day.square() - before > kStrikes * states) return k;
  }
  return std::nullopt;
}

/// Returns the onsets of the best candidates, preceded by the sample before the first that no noise explains.
std::vector<int> common_samples(const CoarseLog& log, const Base& base,
                                const std::vector<CoarseCandidate>& all, int step) {
  std::vector<int> out;
  for (const CoarseCandidate& c : all) {
    const bool apart = std::ranges::all_of(out, [&](int k) { return std::abs(c.sample - k) > 2 * step; });
    if (apart) out.push_back(c.sample);
    if (out.size() == kOnsetsTried) break;
  }
  const std::optional<int> strike = strike_of(log, base);
  if (!strike) return out;
  const bool apart = std::ranges::all_of(out, [&](int o) { return std::abs(*strike - 1 - o) > 1; });
  if (apart) out.insert(out.begin(), std::max(log.first_onset(), *strike - 1));
  return out;
}

/// Distance of the onsets that are tried, and length of the log after each of them that is evaluated.
struct OnsetGrid {
  int step = 1, window = 0;  ///< samples
};

/// Returns the candidates of each group at each onset of the grid.
std::vector<std::vector<CoarseCandidate>> candidates_of(const CoarseLog& log, const Base& base,
                                                        const OnsetGrid& grid) {
  const Catalogue all = catalogue(log);
  const MatrixXd column = log.healthy_steps.columns(all.direction, MatrixXd(all.direction.rows(), 0));
  std::vector<std::vector<CoarseCandidate>> out(all.groups.size());
  for (int k = log.first_onset(); k < log.samples() - 3; k += grid.step) {
    const OnsetSums sums = sums_from(log, base, all, column, k, grid.window);
    for (std::size_t g = 0; g < all.groups.size(); ++g)
      out[g].push_back(candidate(log, all.groups[g], sums, k));
  }
  return out;
}

/// Returns whether some successive samples have larger residuals than noise.
bool strikes(const CoarseLog& log, const Base& base) {
  const int states = log.healthy_steps.states,
            length = std::max(kFewestOfStrike, static_cast<int>(kStrike_s / log.period_s())) * states;
  const double enough = kStandsOut + kSigmasOfStrike * std::sqrt(0.5 * length);
  for (Eigen::Index k = log.first_onset() * states; k + length <= base.left.size(); k += states)
    if (0.5 * (base.left.segment(k, length).squaredNorm() - length) > enough) return true;
  return false;
}

}  // namespace

RoughSearch search_roughly(const CoarseLog& log) {
  const Base base = base_of(log, 0.0);
  RoughSearch out;
  if (strikes(log, base)) return {.stands_out = true};
  const int step = std::max(1, static_cast<int>(std::lround(kRoughStep_s / log.period_s())));
  for (const std::vector<CoarseCandidate>& group : candidates_of(log, base, {step, log.samples()}))
    for (const CoarseCandidate& c : group) {
      if (c.score > kStandsOut) return {.stands_out = true};
      if (!out.nearest || c.score > out.nearest->score) out.nearest = c;
    }
  return out;
}

std::optional<int> first_strike(const CoarseLog& log) { return strike_of(log, base_of(log, kTolerated)); }

CoarseSearch search_coarse(const CoarseLog& log) {
  const Base base = base_of(log, kTolerated);
  const int step = std::max(1, static_cast<int>(std::lround(kOnsetStep_s / log.period_s())));
  const int window = std::max(kFewestWindow, static_cast<int>(kWindow_s / log.period_s()));
  CoarseSearch out;
  for (std::vector<CoarseCandidate>& group : candidates_of(log, base, {step, window}))
    keep_best(std::move(group), 4 * step, out.candidates);
  std::ranges::stable_sort(out.candidates, std::ranges::greater{}, &CoarseCandidate::score);
  out.onsets = common_samples(log, base, out.candidates, step);
  return out;
}

}  // namespace faultline
