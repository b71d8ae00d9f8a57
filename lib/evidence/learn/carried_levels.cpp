// SPDX-License-Identifier: MIT
#include "lib/evidence/learn/carried_levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lib/core/statistics.hpp"
#include "lib/evidence/filter/follower.hpp"
#include "lib/evidence/slow_states.hpp"

namespace faultline {
namespace {

constexpr double kAtRest = 0.05;        // of the usual speed, all joints
constexpr double kRest_s = 0.06;        // at least: what is shorter is a turn
constexpr double kDoubtInPriors = 2.0;  // of what is carried after a rest
constexpr double kMostStd = 3.0;        // times the usual one: what is known worse is left out
constexpr double kFarApart = 5.0;       // times what each group scatters by; one group that is halved: 2.7
constexpr double kSmallestGroup = 0.2;  // share of the motions
constexpr int kFewestMotions = 10, kFewestChanges = 4;
constexpr double kMostByDirection = 0.85;  // of the motions: more is friction
constexpr double kStdOfMedian = 1.4826;    // standard deviation over median of the absolute errors

/// Follows an excerpt and notes each motion.
class MotionLevels {
 public:
  MotionLevels(const MotionModel& model, const HealthyExcerpt& excerpt, int tip)
      : model_(model), excerpt_(excerpt), tip_(tip), follower_(model, excerpt.noise) {}

  std::vector<CarriedLevel> run() {
    const Log& log = excerpt_.log;
    for (int k = 0; k < log.rows(); ++k) {
      follower_.follow(log, k, sample_);
      if (!is_still()) {
        if (!moving_) begin();
        moving_ = true;
        rest_from_s_ = std::numeric_limits<double>::quiet_NaN();
      } else if (moving_) {
        if (std::isnan(rest_from_s_)) rest_from_s_ = sample_.time;
        if (sample_.time - rest_from_s_ >= kRest_s) end();
      }
    }
    return std::move(levels_);
  }

 private:
  bool is_still() const {
    for (int j = 0; j < model_.joints(); ++j)
      if (std::abs(sample_.posterior.mean[model_.joints() + j]) > kAtRest * model_.velocity_scale[j])
        return false;
    return true;
  }

  void begin() {
    row_ = (ended_ + sample_.row) / 2;
    for (int j = 0; j < model_.joints(); ++j) began_[j] = sample_.posterior.mean[j];
  }

  /// From here on anything may be carried.
  void end() {
    GaussianState state = sample_.posterior;
    CarriedLevel level{state.mean[tip_], std::sqrt(state.p(tip_, tip_)), row_, {}};
    for (int j = 0; j < model_.joints(); ++j)
      if (model_.chain.geometry[j].kind == AxisKind::prismatic) level.way[j] = state.mean[j] - began_[j];
    levels_.push_back(level);
    const double doubt = kDoubtInPriors * model_.priors.payload;
    state.p(tip_, tip_) += doubt * doubt;
    follower_.restore(state);
    moving_ = false;
    ended_ = sample_.row;
  }

  const MotionModel& model_;
  const HealthyExcerpt& excerpt_;
  int tip_;
  Follower follower_;
  FollowedSample sample_;
  std::vector<CarriedLevel> levels_;
  std::array<double, kMaxJoints> began_{};
  double rest_from_s_ = std::numeric_limits<double>::quiet_NaN();
  std::int64_t row_ = 0, ended_ = 0;  // of the rest before this motion; where the last one ended
  bool moving_ = false;
};

/// Levels known worse tell nothing.
double most_std(const std::vector<std::vector<CarriedLevel>>& logs) {
  std::vector<double> stds;
  for (const auto& log : logs)
    for (const CarriedLevel& level : log) stds.push_back(level.std);
  return stds.empty() ? 0.0 : kMostStd * upper_median(stds);
}

std::vector<std::vector<CarriedLevel>> well_known(std::vector<std::vector<CarriedLevel>> logs, double most) {
  for (auto& log : logs) std::erase_if(log, [&](const CarriedLevel& level) { return level.std > most; });
  return logs;
}

/// The value that parts the masses into the two groups that scatter least.
double parting(std::vector<double> kg) {
  std::sort(kg.begin(), kg.end());
  double sum = 0.0, all = 0.0;
  for (const double x : kg) all += x;
  std::size_t best = 1;
  double best_between = -1.0;
  for (std::size_t i = 1; i < kg.size(); ++i) {
    sum += kg[i - 1];
    const auto low = static_cast<double>(i), high = static_cast<double>(kg.size() - i);
    const double apart = (all - sum) / high - sum / low;
    if (const double between = low * high * apart * apart; between > best_between)
      best_between = between, best = i;
  }
  return 0.5 * (kg[best - 1] + kg[best]);
}

struct LevelGroup {
  std::vector<double> kg;
  std::array<double, kMaxJoints> forward{};  ///< motions in which the joint went that way

  void add(const CarriedLevel& level) {
    kg.push_back(level.kg);
    for (int j = 0; j < kMaxJoints; ++j) forward[j] += level.way[j] > 0.0;
  }
  double scatter() const {
    const double middle = upper_median(kg);
    std::vector<double> errors;
    for (const double x : kg) errors.push_back(std::abs(x - middle));
    return kStdOfMedian * upper_median(errors);
  }
};

/// Whether the way that one joint goes tells nearly all motions of one group from those of the other.
bool differ_by_direction(const LevelGroup& a, const LevelGroup& b) {
  const auto all = static_cast<double>(a.kg.size() + b.kg.size());
  return std::any_of(a.forward.begin(), a.forward.end(), [&, j = 0](double forward) mutable {
    const double told = (forward + static_cast<double>(b.kg.size()) - b.forward[j++]) / all;
    return std::max(told, 1.0 - told) > kMostByDirection;
  });
}

}  // namespace

std::vector<CarriedLevel> carried_levels(const MotionModel& model, const HealthyExcerpt& excerpt) {
  const int tip = tip_mass_index(model);
  return tip < 0 ? std::vector<CarriedLevel>{} : MotionLevels(model, excerpt, tip).run();
}

ShownPiece piece_that_comes_and_goes(const std::vector<std::vector<CarriedLevel>>& logs) {
  ShownPiece piece;
  piece.most_std = most_std(logs);
  const std::vector<std::vector<CarriedLevel>> levels = well_known(logs, piece.most_std);
  std::vector<double> kg;
  for (const auto& log : levels)
    for (const CarriedLevel& level : log) kg.push_back(level.kg);
  if (static_cast<int>(kg.size()) < kFewestMotions) return piece;
  piece.border_kg = parting(kg);
  LevelGroup low, high;
  for (const auto& log : levels)
    for (const CarriedLevel& level : log) (level.kg > piece.border_kg ? high : low).add(level);
  int changes = 0;
  for (const auto& log : levels) changes += static_cast<int>(changes_between(log, piece).size());
  const double fewest = std::max(kSmallestGroup * static_cast<double>(kg.size()), 2.0);
  if (changes < kFewestChanges || static_cast<double>(std::min(low.kg.size(), high.kg.size())) < fewest)
    return piece;
  if (differ_by_direction(low, high)) return piece;
  const double mass = upper_median(high.kg) - upper_median(low.kg);
  if (mass > kFarApart * std::max(low.scatter(), high.scatter())) piece.kg = mass;
  return piece;
}

std::vector<WorkPieceChange> changes_between(const std::vector<CarriedLevel>& levels,
                                             const ShownPiece& piece) {
  std::vector<WorkPieceChange> changes;
  std::optional<bool> carried;
  for (const CarriedLevel& level : levels) {
    if (level.std > piece.most_std) continue;
    const bool carries = level.kg > piece.border_kg;
    if (carried && carries != *carried) changes.push_back({level.row, carries ? piece.kg : -piece.kg});
    carried = carries;
  }
  return changes;
}

}  // namespace faultline
