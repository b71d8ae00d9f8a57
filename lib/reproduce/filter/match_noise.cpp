// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/match_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/parallel.hpp"
#include "lib/core/statistics.hpp"
#include "lib/reproduce/filter/follow_excerpt.hpp"

namespace faultline {
namespace {

constexpr int kNoiseSettlingRows = 10;  // at the start of a log, which the filter needs to forget its guess
// Factors of the search: each round takes the square root of the one before, but by no less than the last,
// for likelihood is flat within it.
constexpr double kCoarseFactor = 4.0, kFineFactor = 2.0, kLastFactor = 1.2;
// The coarse rounds look at this many rows of all logs together; the fine ones at all of the excerpts, since
// what wanders shows in long pieces only.
constexpr int kCoarseRounds = 3, kCoarseRows = 3000;
constexpr int kFineRounds = 3;
constexpr int kFewestPieces = 6;  // that the rows are spread over, so that every kind of motion is among them
constexpr int kFewestPieceRows = 250;  // shorter ones say little of what wanders
constexpr double kGain = 1e-9;         // of the likelihood: less is rounding

// A torque that is missed for longer than this is an offset, for less than this white noise.
constexpr double kLongestMemory_s = 2.0;
constexpr double kShortestMemory_s = 0.002;
constexpr double kFastestFriction = 0.1;  // share a second (root of time): faster is no wear and no warmth
constexpr double kWorstClock_s = 0.1;

constexpr double kWobble = 0.01;  // of a period

constexpr double kOneCode = 0.05;  // of the changes: the least are by one code of a coarse sensor
constexpr double kNoiseUniformSpread =
    12.0;  // an error that is uniform over a code has this share of its square

double log_likelihood_of(const HealthyExcerpt& excerpt, const MotionModel& model) {
  double sum = 0.0;
  int rows = 0;
  follow_excerpt(excerpt, model, [&](const FollowedSample& sample) {
    if (rows++ > kNoiseSettlingRows) sum += sample.total_log_likelihood;
  });
  return std::isfinite(sum) ? sum : -std::numeric_limits<double>::max();
}

double log_likelihood(const std::vector<HealthyExcerpt>& logs, const MotionModel& model, int threads) {
  std::vector<double> parts(logs.size());
  parallel_for(static_cast<int>(logs.size()), threads,
               [&](int i) { parts[i] = log_likelihood_of(logs[i], model); });
  double sum = 0.0;
  for (const double part : parts) sum += part;
  return sum;
}

/// Pieces of the excerpts with about `rows` rows in all, spread evenly; the excerpts themselves where they
/// have no more.
std::vector<HealthyExcerpt> spread(const std::vector<HealthyExcerpt>& excerpts, int rows) {
  const int count = static_cast<int>(excerpts.size());
  const int each = (kFewestPieces + count - 1) / std::max(count, 1);
  const int piece = std::max(rows / std::max(each * count, 1), kFewestPieceRows);
  std::vector<HealthyExcerpt> out;
  for (const HealthyExcerpt& excerpt : excerpts) {
    const int all = excerpt.log.rows(), pieces = std::min(each, all / piece);
    if (pieces * piece * 2 > all * 2 - piece || pieces == 0) {
      out.push_back(excerpt);
      continue;
    }
    for (int p = 0; p < pieces; ++p) {
      const int begin = pieces > 1 ? p * (all - piece) / (pieces - 1) : (all - piece) / 2;
      out.push_back({slice(excerpt.log, begin, begin + piece), excerpt.noise});
    }
  }
  return out;
}

/// Numbers that the search moves together, by factors, between bounds.
struct NumberGroup {
  std::vector<double*> numbers;
  double low = 0.0;
  double high = std::numeric_limits<double>::infinity();
  bool last_up = true;                                          ///< the direction that helped last
  double settled_at = std::numeric_limits<double>::infinity();  ///< a factor that helped in no direction

  bool scale(double by) {
    for (const double* number : numbers)
      if (*number * by < low || *number * by > high) return false;
    for (double* number : numbers) *number *= by;
    return true;
  }
};

/// Each value alone: sensors and drives of different joints have nothing in common.
void add_each(std::vector<double>& values, const std::vector<double>& low, std::vector<NumberGroup>& groups) {
  for (std::size_t j = 0; j < values.size(); ++j)
    groups.push_back({{&values[j]}, j < low.size() ? low[j] : 0.0});
}

/// Of the velocities that are measured.
void add_measured(MotionModel& model, const std::vector<double>& low, std::vector<NumberGroup>& groups) {
  for (std::size_t j = 0; j < model.dq_std.size(); ++j)
    if (model.dq_is_difference.empty() || !model.dq_is_difference[j])
      groups.push_back({{&model.dq_std[j]}, low[j]});
}

void add_slow_groups(MotionModel& model, std::vector<NumberGroup>& groups) {
  NumberGroup memory{{}, kShortestMemory_s, kLongestMemory_s}, friction{{}, 0.0, kFastestFriction};
  for (SlowState& slow : model.slow) {
    switch (slow.kind) {
      case SlowKind::friction:
        friction.numbers.push_back(&slow.walk);
        break;
      case SlowKind::coloured_torque:
        groups.push_back({{&slow.day_std}});
        memory.numbers.push_back(&slow.memory_s);
        break;
      case SlowKind::torque_gain:
      case SlowKind::torque_offset:
      case SlowKind::tip_mass:
        break;
    }
  }
  if (!memory.numbers.empty()) groups.push_back(memory);
  if (!friction.numbers.empty()) groups.push_back(friction);
  if (model.clock_std > 0.0) groups.push_back({{&model.clock_std}, 0.0, kWorstClock_s});
}

/// Half of what separates two neighbouring codes of a sensor, as a standard deviation; 0 for none seen.
double code_std(const std::vector<HealthyExcerpt>& logs, int joint, bool velocity) {
  std::vector<double> steps;
  for (const HealthyExcerpt& excerpt : logs) {
    const JointSignals& signals = velocity ? excerpt.log.dq : excerpt.log.q;
    if (signals.empty()) continue;
    const std::vector<double>& x = signals[joint];
    for (std::size_t k = 1; k < x.size(); ++k)
      if (x[k] != x[k - 1] && std::isfinite(x[k] - x[k - 1])) steps.push_back(std::abs(x[k] - x[k - 1]));
  }
  return steps.empty() ? 0.0 : lower_quantile(steps, kOneCode) / std::sqrt(kNoiseUniformSpread);
}

std::vector<double> code_stds(const std::vector<HealthyExcerpt>& logs, int joints, bool velocity) {
  std::vector<double> out;
  for (int j = 0; j < joints; ++j) out.push_back(code_std(logs, j, velocity));
  return out;
}

/// What the search moves.
std::vector<NumberGroup> free_numbers(MotionModel& model, const std::vector<HealthyExcerpt>& logs,
                                      bool held) {
  std::vector<NumberGroup> groups = {{{&model.noise.torque_share}}, {{&model.noise.rest_share}}};
  add_each(model.noise.floor, {}, groups);
  add_each(model.q_std, code_stds(logs, model.joints(), false), groups);
  add_measured(model, code_stds(logs, model.joints(), true), groups);
  if (!held) groups.push_back({{&model.noise.step_share}});
  add_each(model.noise.compliance, {}, groups);
  add_slow_groups(model, groups);
  return groups;
}

/// Coordinate search by factors of the likelihood of the pieces: one round a factor.
class Search {
 public:
  Search(MotionModel& model, const std::vector<HealthyExcerpt>& pieces, std::vector<NumberGroup>& groups,
         int threads)
      : model_(model), pieces_(pieces), groups_(groups), threads_(threads) {
    best_ = log_likelihood(pieces_, model_, threads_);
  }

  void round(double factor) {
    for (NumberGroup& group : groups_) {
      if (group.settled_at <= factor) continue;
      const bool up = group.last_up;
      const bool moved = move(group, up ? factor : 1.0 / factor) || move(group, up ? 1.0 / factor : factor);
      group.settled_at = moved ? std::numeric_limits<double>::infinity() : factor;
    }
  }

 private:
  bool move(NumberGroup& group, double by) {
    if (!group.scale(by)) return false;
    const double moved = log_likelihood(pieces_, model_, threads_);
    if (moved > best_ + kGain * std::abs(best_)) {
      best_ = moved;
      group.last_up = by > 1.0;
      return true;
    }
    for (double* number : group.numbers) *number *= 1.0 / by;
    return false;
  }

  MotionModel& model_;
  const std::vector<HealthyExcerpt>& pieces_;
  std::vector<NumberGroup>& groups_;
  int threads_;
  double best_ = 0.0;
};

/// Coarsely on few rows, then finely on all.
void search(MotionModel& model, const std::vector<HealthyExcerpt>& logs, const MatchOptions& options) {
  std::vector<NumberGroup> groups = free_numbers(model, logs, options.held);
  auto rounds = [&](int count, double factor, const std::vector<HealthyExcerpt>& pieces) {
    Search on_pieces(model, pieces, groups, options.threads);
    for (NumberGroup& group : groups) group.settled_at = std::numeric_limits<double>::infinity();
    for (int round = 0; round < count; ++round) {
      on_pieces.round(factor);
      factor = std::max(std::sqrt(factor), kLastFactor);
    }
  };
  rounds(kCoarseRounds, kCoarseFactor, spread(logs, kCoarseRows));
  rounds(kFineRounds, kFineFactor, logs);
}

/// The stamps of the logs differ from steps of a period.
bool wobbles(const std::vector<HealthyExcerpt>& logs, double period) {
  for (const HealthyExcerpt& excerpt : logs)
    for (int k = 1; k < excerpt.log.rows(); ++k) {
      const double periods = (excerpt.log.time[k] - excerpt.log.time[k - 1]) / period;
      if (std::abs(periods - std::round(periods)) > kWobble) return true;
    }
  return false;
}

}  // namespace

void match_noise(MotionModel& model, const std::vector<HealthyExcerpt>& logs, const MatchOptions& options) {
  if (model.clock_std > 0.0 && wobbles(logs, options.period_s)) {
    model.steady_period_s = 0.0;
    const double as_stamped = log_likelihood(logs, model, options.threads);
    model.steady_period_s = options.period_s;
    if (log_likelihood(logs, model, options.threads) < as_stamped) model.steady_period_s = 0.0;
  }
  search(model, logs, options);
}

}  // namespace faultline
