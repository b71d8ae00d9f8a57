// SPDX-License-Identifier: MIT
#include "lib/evidence/survey/survey_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lib/core/make_issue.hpp"
#include "lib/core/statistics.hpp"
#include "lib/evidence/filter/follower.hpp"
#include "lib/evidence/slow_states.hpp"
#include "lib/evidence/survey/stretches.hpp"

namespace faultline {
namespace {

constexpr int kSurveyedRows = 4000;      // enough calm blocks at any rate
constexpr int kSurveySettlingRows = 10;  // which the filter needs to forget its guess
constexpr double kWellExplained = 1.2;   // mean chi-square of a number: nothing is tried below
constexpr int kPeriodRows = 32;
constexpr double kLostRow = 0.75;      // periods more than those rows take
constexpr double kLeastGain = 10.0;    // nats, in one of the first two stretches that move
constexpr double kLeastHidden = 20.0;  // nats, likewise, where the motion is well explained all the same
constexpr double kClearlyMore = 1.01;  // times the gain of a torque that is less rough
constexpr double kFromTheStart = 0.1;  // of what the second gains by the way it goes, the first gains too
constexpr double kMostOfFirst = 2.0;  // times the first gain: more, or a loss, may be a fault that came later
constexpr double kPeaks = 2.0;        // times the level that suits the whole, for where it peaks
constexpr double kHidden = 1.5;       // times its noise: what jitters there is motion, not noise
constexpr std::array kNoiseLevels = {1.4142, 2.0};                       // times the usual
constexpr std::array kShares = {0.003, 0.006, 0.012, 0.025, 0.05, 0.1};  // of the largest torque
constexpr std::array kMemories_s = {0.004, 0.03, 0.12};  // of a spring, of a shape of friction, of a ripple

/// How well a day explains the rows.
struct Explained {
  std::array<double, kStretches> log_likelihood{};
  std::array<double, kStretches> chi_square{};  ///< mean of a number
};

Log first_rows(LogSource& log) {
  log.rewind();
  Log first;
  for (Log segment; first.rows() < kSurveyedRows && log.next(segment);)
    append(first, slice(segment, 0, std::min(segment.rows(), kSurveyedRows - first.rows())));
  log.rewind();
  return first;
}

/// The torque of row k is that of row k + rows.
Log with_torque_shifted(Log log, int rows) {
  for (std::vector<double>& tau : log.tau) {
    const std::vector<double> logged = tau;
    for (int k = 0; k < log.rows(); ++k) tau[k] = logged[std::clamp(k + rows, 0, log.rows() - 1)];
  }
  return log;
}

Explained explained(const Log& rows, const MotionModel& model, const LogNoise& noise) {
  Explained out;
  Follower follower(model, noise);
  FollowedSample sample;
  std::array<long long, kStretches> numbers{};
  for (int k = 0; k < rows.rows(); ++k) {
    follower.follow(rows, k, sample);
    if (k < kSurveySettlingRows) continue;
    const std::size_t stretch = stretch_of(k, rows.rows());
    out.log_likelihood[stretch] += sample.total_log_likelihood;
    for (int j = 0; j < model.joints(); ++j) {
      out.chi_square[stretch] += sample.chi_square[j];
      numbers[stretch] += std::isfinite(sample.q[j]) + std::isfinite(sample.dq[j]);
    }
  }
  for (int s = 0; s < kStretches; ++s)
    if (numbers[s] > 0) out.chi_square[s] /= static_cast<double>(numbers[s]);
  return out;
}

/// Median of the steps over some rows, which wobble less than single ones.
double rough_period(const Log& rows, int over) {
  std::vector<double> periods;
  for (int k = over; k < rows.rows(); ++k) periods.push_back((rows.time[k] - rows.time[k - over]) / over);
  return upper_median(periods);
}

/// From the first row to the last, over the rows between them and those that were lost there.
double mean_period(const Log& rows) {
  const int over = std::min(kPeriodRows, rows.rows() - 1), last = rows.rows() - 1;
  const double rough = rough_period(rows, over);
  double steps = last;
  for (int k = 0; k + over <= last; k += over) {
    const double more = (rows.time[k + over] - rows.time[k]) / rough - over;
    if (more > kLostRow) steps += std::round(more);
  }
  return (rows.time[last] - rows.time[0]) / steps;
}

class Survey {
 public:
  Survey(const Log& rows, const MotionModel& model) : rows_(rows) {
    day_.model = model;
    day_.noise = log_noise(model, rows);
  }

  LogDay run() {
    if (rows_.rows() < 2 * kStretches) return std::move(day_);
    moving_ = first_moving(rows_, day_.model);
    way_ = way_of(rows_, day_.model);
    best_ = explained(rows_, day_.model, day_.noise);
    if (rows_.tau.empty()) return std::move(day_);
    if (is_badly_explained()) {
      try_stamps_and_timing();
      try_noisy_readings();
    }
    if (is_badly_explained() || gains_by_little()) try_rough_torque();
    return std::move(day_);
  }

 private:
  /// The first stretches of motion alone say so: later ones may be faulty.
  bool is_badly_explained() const {
    return std::any_of(moving_.begin(), moving_.end(),
                       [&](int s) { return best_.chi_square[s] > kWellExplained; });
  }

  /// What a day gains, as far as the first stretches speak for it; 0 where they do not, or where only the
  /// second does: a fault may have begun there.
  double gain_of(const Explained& with, double least = kLeastGain) const {
    const auto gain = [&](int s) { return with.log_likelihood[s] - best_.log_likelihood[s]; };
    double first = 0.0;
    for (const int s : moving_) first = std::max(first, gain(s));
    if (first < least) return 0.0;
    const int begins = moving_.front(), goes_on = moving_.back();
    if (gain(begins) * way_[goes_on] < kFromTheStart * gain(goes_on) * way_[begins]) return 0.0;
    double sum = 0.0;
    for (int s = 0; s < kStretches; ++s)
      sum += std::clamp(gain(s), -kMostOfFirst * first, kMostOfFirst * first);
    return sum;
  }

  void try_stamps_and_timing() {
    const double period = mean_period(rows_);
    MotionModel steady = day_.model;
    steady.steady_period_s = period;
    const Explained in_step = explained(rows_, steady, day_.noise);
    const bool may_wobble = day_.model.steady_period_s == 0.0 && day_.model.clock_std > 0.0;
    const double gain_in_step = may_wobble ? gain_of(in_step) : 0.0;
    double best_gain = gain_in_step;
    int best_shift = 0;
    Explained shifted_best;
    for (const int shift : {1, -1}) {
      const Explained shifted = explained(with_torque_shifted(rows_, shift), day_.model, day_.noise);
      if (const double gain = gain_of(shifted); gain > best_gain)
        best_gain = gain, best_shift = shift, shifted_best = shifted;
    }
    if (best_gain <= 0.0) return;
    if (best_shift == 0) {
      day_.model = std::move(steady);
      best_ = in_step;
      note("stamps_wobble",
           "the time stamps wobble, as those of the learned logs do not; the rows are taken in step");
      return;
    }
    rows_ = with_torque_shifted(rows_, best_shift);
    best_ = shifted_best;
    day_.torque_delay_s.assign(day_.model.joints(), -best_shift * period);
    note("torque_timing",
         fmt::format("the torque is logged a row {} than in the learned logs; it is taken where it acts",
                     best_shift > 0 ? "later" : "earlier"));
  }

  /// Rows too far apart to tell a log's noise from its motion: the filter tells it.
  LogNoise noisier(double level) const {
    const MotionModel& model = day_.model;
    const auto raise = [&](double& scale, const std::vector<double>& usual, const std::vector<double>& std,
                           std::size_t j) {
      if (j < usual.size() && j < std.size() && usual[j] > kHidden * std[j])
        scale = std::max(scale, std::min(level, model.noise_range[1]));
    };
    LogNoise noise = day_.noise;
    for (std::size_t j = 0; j < static_cast<std::size_t>(model.joints()); ++j) {
      raise(noise.q_scale[j], model.usual_noise.q, model.q_std, j);
      raise(noise.dq_scale[j], model.usual_noise.dq, model.dq_std, j);
    }
    return noise;
  }

  void try_noisy_readings() {
    LogNoise best = day_.noise;
    Explained best_explained = best_;
    double best_gain = 0.0;
    for (const double level : kNoiseLevels) {
      const LogNoise noise = noisier(level);
      if (noise.q_scale == day_.noise.q_scale && noise.dq_scale == day_.noise.dq_scale) continue;
      const Explained with = explained(rows_, day_.model, noise);
      if (const double gain = gain_of(with); gain > best_gain)
        best_gain = gain, best = noise, best_explained = with;
    }
    if (best_gain <= 0.0) return;
    day_.noise = best;
    best_ = best_explained;
    note("noisy_readings", "the readings jitter more than in the learned logs; small faults are seen later");
  }

  /// The day with a coloured torque of `joint` (-1: of all) that is at least that rough.
  std::optional<MotionModel> rougher(int joint, double share, double memory_s) const {
    MotionModel model = day_.model;
    bool changed = false;
    for (SlowState& slow : model.slow) {
      if (slow.kind != SlowKind::coloured_torque || (joint >= 0 && slow.joint != joint)) continue;
      const double level = share * model.torque_scale[slow.joint];
      if (level <= slow.day_std) continue;
      slow.day_std = level;
      slow.memory_s = memory_s;
      changed = true;
    }
    if (!changed) return std::nullopt;
    return model;
  }

  /// Slow states may hide for a while what a rougher torque explains better: whether the least of it gains.
  bool gains_by_little() const {
    for (const double memory_s : kMemories_s) {
      std::optional<MotionModel> model;
      for (auto share = kShares.begin(); share != kShares.end() && !model; ++share)
        model = rougher(-1, *share, memory_s);
      if (model && gain_of(explained(rows_, *model, day_.noise), kLeastHidden) > 0.0) return true;
    }
    return false;
  }

  /// All joints alike, then each more.
  void try_rough_torque() {
    const MotionModel before = day_.model;
    bool rough = false;
    for (int joint = -1; joint < before.joints(); ++joint) rough = try_rough_torque(joint) || rough;
    if (!rough) return;
    day_.roughness.assign(before.joints(), 1.0);
    for (std::size_t s = 0; s < before.slow.size(); ++s) {
      SlowState& slow = day_.model.slow[s];
      const double usual = before.slow[s].day_std;
      if (slow.day_std <= usual) continue;
      slow.day_std *= kPeaks;
      day_.roughness[slow.joint] = slow.day_std / usual;
    }
    note("torque_rough",
         "the model misses more torque in this log than in the learned ones from its first rows on; "
         "small faults are seen later or not at all");
  }

  bool try_rough_torque(int joint) {
    std::optional<MotionModel> best;
    Explained best_explained;
    double best_gain = 0.0;
    for (const double memory_s : kMemories_s)
      for (const double share : kShares) {
        std::optional<MotionModel> model = rougher(joint, share, memory_s);
        if (!model) continue;
        const Explained with = explained(rows_, *model, day_.noise);
        if (const double gain = gain_of(with); gain > kClearlyMore * best_gain)
          best_gain = gain, best = std::move(model), best_explained = with;
      }
    if (!best) return false;
    day_.model = std::move(*best);
    best_ = best_explained;
    return true;
  }

  void note(const char* code, std::string message) {
    day_.notes.add(make_issue(code, Severity::note, std::move(message)));
  }

  Log rows_;
  LogDay day_;
  std::vector<int> moving_;
  std::array<double, kStretches> way_{};
  Explained best_;
};

}  // namespace

LogNoise survey_noise(LogSource& log, const MotionModel& model) { return log_noise(model, first_rows(log)); }

LogDay survey_log(LogSource& log, const MotionModel& model) {
  const Log rows = first_rows(log);
  return Survey(rows, model).run();
}

}  // namespace faultline
