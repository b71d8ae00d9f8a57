// SPDX-License-Identifier: MIT
#include "lib/evidence/watch/watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faultline {

Watch::Watch(const MotionModel& model, const std::vector<Hypothesis>& hypotheses,
             const EvidenceOptions& options, const LogNoise& noise)
    : robot_{model, {}, {}},
      options_(options),
      follower_(robot_.model, noise),
      trigger_(robot_.model),
      bank_(robot_.model, follower_.dynamics(), hypotheses),
      history_(kHistory) {}

Watch::Watch(const Watch& before, FaultyRobot robot, const GaussianState& state,
             const EvidenceOptions& options)
    : robot_(std::move(robot)),
      options_(options),
      follower_(before.follower_, robot_.model, robot_.faults),
      trigger_(robot_.model),
      bank_(robot_.model, follower_.dynamics(), before.bank_.hypotheses(), robot_.closed),
      history_(kHistory) {
  may_learn_range_ = false;
  follower_.restore(state);
  FollowedSample& first = history_.push();
  first = before.history_.back();
  first.posterior = state;
}

void Watch::follow(const Log& segment, int row) {
  FollowedSample& sample = history_.push();
  follower_.follow(segment, row, sample);
  statistic_ = trigger_.take(sample);
}

bool Watch::is_sound() const {
  const GaussianState& state = sample().posterior;
  return std::all_of(state.mean.begin(), state.mean.begin() + state.size,
                     [](double x) { return std::isfinite(x); });
}

bool Watch::suspicious() const {
  return statistic_ > options_.trigger || trigger_.repeated_codes() >= kSuspiciousRepeats;
}

std::optional<HypothesisTest::Conclusion> Watch::look() {
  if (sample().dt <= 0.0) restart_ = history_.last();
  if (!test_) {
    watch();
    return std::nullopt;
  }
  if (is_outgrown()) {
    test_now();
    return std::nullopt;
  }
  test_->advance();
  return test_->ready() ? conclude() : std::nullopt;
}

std::optional<HypothesisTest::Conclusion> Watch::interrupt() { return test_ ? conclude() : std::nullopt; }

void Watch::move_with(const GaussianState& motion) { follower_.stand_by(*kept_, motion); }

void Watch::stand_by(std::int64_t onset) {
  kept_ = history_[std::max(onset - 1, history_.first())].posterior;
}

void Watch::begin_anew() {
  kept_.reset();
  restart_ = history_.last();
  rearm_row_ = -1;
  test_.reset();
  trigger_.forget();
}

void Watch::watch() {
  const FollowedSample& now = sample();
  const int repeats = trigger_.repeated_codes();
  // A statistic that a rejected suspicion already looked into is old news until it grows or decays.
  if (now.row < rearm_row_ && statistic_ < kNewSuspicion * looked_into_ && repeats != kSuspiciousRepeats)
    return;
  largest_trigger_ = std::max(largest_trigger_, statistic_);
  if (statistic_ < kCalm * options_.trigger && may_learn_range_) follower_.learn_range(now);
  if (!suspicious()) return;
  test_now();
}

void Watch::test_now() {
  looked_into_ = statistic_;
  test_.emplace(bank_, history_, options_, restart_, trigger_.repeated_codes());
}

/// Names the fault, or lets the suspicion go when its evidence did not last.
std::optional<HypothesisTest::Conclusion> Watch::conclude() {
  rearm_row_ = sample().row + kRearm;
  std::optional<HypothesisTest::Conclusion> named;
  const bool is_over = test_->alarmed() && !test_->passes() && test_->return_to_peak();
  const RunningHypothesis* no_fault = test_->no_fault();
  if (no_fault && !is_over) {
    go_on_from(test_->refined(*no_fault));
  } else if (!test_->alarmed()) {
    largest_ratio_ = std::max(largest_ratio_, test_->largest_ratio());
  } else if (no_fault || !test_->passes()) {
    ++rejected_alarms_;
  } else if (options_.only_measure) {
    measure();
  } else {
    named = name(is_over);
  }
  test_.reset();
  return named;
}

/// Whether what was explained until it collapsed is a fault that ended: a push tells its own end, and the
/// code of a joint that rests repeats by itself.
bool Watch::has_ended(const RunningHypothesis& best) const {
  const FaultLabel& label = bank_.hypotheses()[best.hypothesis].label;
  if (is_healthy(bank_.hypotheses()[best.hypothesis]) || describe(label.kind).passes ||
      label.kind == FaultKind::unknown)
    return false;
  if (label.kind != FaultKind::stuck_encoder) return true;
  const int j = label.joint - 1;
  const double at_onset = history_[std::max(best.onset, history_.first())].posterior.mean[j];
  return std::abs(best.state.mean[j] - at_onset) > kMoved * robot_.model.q_std[j];
}

std::optional<HypothesisTest::Conclusion> Watch::name(bool is_over) {
  HypothesisTest::Conclusion found = test_->conclude();
  found.is_over = is_over;
  if (is_over && !has_ended(found.best)) {
    ++rejected_alarms_;
    return std::nullopt;
  }
  if (!is_healthy(bank_.hypotheses()[found.best.hypothesis])) return found;
  go_on_from(found.best);
  return std::nullopt;
}

void Watch::measure() {
  const std::vector<double> ratios = test_->excess_ratios();
  largest_ratios_.resize(ratios.size(), 0.0);
  for (std::size_t h = 0; h < ratios.size(); ++h)
    largest_ratios_[h] = std::max(largest_ratios_[h], ratios[h]);
}

/// The robot is healthy all the same. Filters before a change of the work piece know nothing of it.
void Watch::go_on_from(const RunningHypothesis& no_fault) {
  follower_.restore(no_fault.state);
  const Hypothesis& hypothesis = bank_.hypotheses()[no_fault.hypothesis];
  if (is_misread(hypothesis)) {
    rejected_alarms_ += test_->alarmed();
    return;
  }
  restart_ = history_.last();
  trigger_.forget();
  work_piece_changes_.push_back({history_[no_fault.onset].row, hypothesis.work_piece_kg});
  bank_.work_piece_changed(hypothesis.work_piece_kg);
}

void Watch::go_on_healed(std::int64_t onset) {
  follower_.stand_by(history_[std::max(onset - 1, history_.first())].posterior, sample().posterior);
  begin_anew();
}

void Watch::go_on_after(const RunningHypothesis& passed) {
  follower_.restore(take_fault(robot_, bank_.hypotheses()[passed.hypothesis], passed));
  begin_anew();
}

}  // namespace faultline
