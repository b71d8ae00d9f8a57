// SPDX-License-Identifier: MIT
#include "lib/evidence/hypothesis_test.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lib/evidence/refined_run.hpp"
#include "lib/evidence/standstill.hpp"

namespace faultline {
namespace {

/// How far back faults are tried to have begun, in samples before the trigger.
constexpr std::array<int, 16> kOffsets = {0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 256};
constexpr int kSlowOffset = 16;      // farther back only what creeps, or hides at rest, is tried
constexpr double kLookBack_s = 2.5;  // and never farther: what has crept that long has grown past the trigger
// Most of the bank's work is spared by dropping what cannot win any more.
constexpr int kFirstPrune = 12;        // samples after the trigger: two onsets a hypothesis stay
constexpr int kFewestBeforePrune = 4;  // at low rates, when this many samples take this long
constexpr double kFirstPrune_s = 0.25;
constexpr int kSecondPrune = 40;         // one onset stays, and only hypotheses within kHopeless of the best
constexpr int kPruneEvery = 20;          // samples, from then on
constexpr double kHopeless = 60.0;       // nats: odds of 1e26, which no onset can make good
constexpr double kWorthRefining = 25.0;  // nats: from farther behind a finer onset would not win
constexpr int kMostRefined = 6;          // hypotheses
constexpr double kRanAway = 300.0;       // nats: no row that a filter still follows can cost so much
constexpr int kFewestConfirm = 16;       // samples
constexpr int kUsualRows = 512;          // before the onset, for what is usually left unexplained
constexpr double kOver_s = 0.25;         // of calm after a push, which tells it from what goes on
constexpr double kOverThreshold = 4.0;   // thresholds that an alarm reached which nothing explains in the end
constexpr double kHigher = 1.1;          // times the last peak: less is no other
constexpr double kShortestCheck_s = 0.05;  // of an alarm that turns out to be no fault

void add_to(Surprise& surprise, const FollowedSample& at, int joints) {
  for (int j = 0; j < joints && at.in_range; ++j)
    if (!at.pressed[j] && !at.repeats[j] && std::isfinite(at.q[j]))
      surprise.add(j, at.whitened[j], at.whitened[joints + j], std::isfinite(at.dq[j]));
}

/// By how much healthy days imitate each hypothesis.
std::vector<double> imitations_of(const std::vector<Hypothesis>& hypotheses, const EvidenceOptions& options) {
  std::vector<double> nats;
  for (const Hypothesis& hypothesis : hypotheses) nats.push_back(options.imitation_of(hypothesis.label));
  return nats;
}

}  // namespace

HypothesisTest::HypothesisTest(const Bank& bank, const History& history, const EvidenceOptions& options,
                               std::int64_t restart, int repeats)
    : bank_(bank),
      history_(history),
      options_(options),
      imitation_(imitations_of(bank.hypotheses(), options)),
      earliest_(std::max(restart, history.first()) + 1),
      trigger_(history.last()),
      now_(history.last()) {
  for (const int offset : kOffsets) begin_at(trigger_ - offset, offset > kSlowOffset);
  if (repeats > 0 && std::find(kOffsets.begin(), kOffsets.end(), repeats - 1) == kOffsets.end())
    begin_at(trigger_ - repeats + 1, false);
  update();
}

RunningHypothesis HypothesisTest::run(int hypothesis, std::int64_t onset) const {
  return run_hypothesis(bank_, history_, hypothesis, onset, now_);
}

void HypothesisTest::begin_at(std::int64_t onset, bool slow_only) {
  if (onset < earliest_ || history_[trigger_].time - history_[onset].time > kLookBack_s) return;
  for (std::size_t h = 0; h < bank_.hypotheses().size(); ++h)
    if (const Hypothesis& hypothesis = bank_.hypotheses()[h];
        bank_.asks_for(hypothesis) && (!slow_only || describe(hypothesis.label.kind).creeps ||
                                       hypothesis.form == HypothesisForm::work_piece))
      running_.push_back(run(static_cast<int>(h), onset));
}

void HypothesisTest::advance() {
  if (lost_) return;
  const bool stands = alarmed() && now_ - alarm_ >= options_.fewest_samples;
  const double ratio_before = best_ratio_;
  if (stands) before_ = running_;
  ++now_;
  for (RunningHypothesis& running : running_) bank_.advance(running, history_[now_ - 1], history_[now_]);
  update();
  note_peak();
  if (stands && !(best_ratio_ > ratio_before - kRanAway)) {
    lost_ = true;
    --now_;
    running_.swap(before_);
    update();
    return;
  }
  const std::int64_t since = now_ - trigger_;
  const bool slow = history_[now_].time - history_[trigger_].time >= kFirstPrune_s;
  const bool first_time = !pruned_ && (since >= kFirstPrune || (slow && since >= kFewestBeforePrune));
  if (first_time || (since >= kSecondPrune && since % kPruneEvery == 0)) prune();
}

/// A fault that healthy days imitate raises an alarm only as far as it goes beyond them.
double HypothesisTest::counted(const RunningHypothesis& running) const {
  return running.log_likelihood_ratio - imitation_[running.hypothesis];
}

void HypothesisTest::update() {
  best_ratio_ = best_counted_ = -std::numeric_limits<double>::infinity();
  for (const RunningHypothesis& running : running_) {
    best_ratio_ = std::max(best_ratio_, running.log_likelihood_ratio);
    best_counted_ = std::max(best_counted_, counted(running));
  }
  largest_ratio_ = std::max(largest_ratio_, best_counted_);
  if (alarm_ < 0 && best_counted_ > options_.threshold) alarm_ = now_;
}

void HypothesisTest::note_peak() {
  const bool stands = alarmed() && now_ - alarm_ >= options_.fewest_samples &&
                      history_[now_].time - history_[alarm_].time >= kShortestCheck_s;
  if (!stands || best_counted_ < std::max(kOverThreshold * options_.threshold, kHigher * peak_counted_))
    return;
  if (best_counted_ < largest_ratio_) return;  // what a wild value said wanes from the row after it
  at_peak_ = running_;
  peak_ = now_;
  peak_counted_ = best_counted_;
}

bool HypothesisTest::return_to_peak() {
  if (peak_ < 0) return false;
  now_ = peak_;
  running_ = at_peak_;
  update();
  return true;
}

void HypothesisTest::prune() {
  pruned_ = true;
  const bool second = now_ - trigger_ >= kSecondPrune;
  const std::size_t keep = second ? 1 : 2;
  std::stable_sort(running_.begin(), running_.end(), [](const auto& a, const auto& b) {
    return a.hypothesis != b.hypothesis ? a.hypothesis < b.hypothesis : better(a, b);
  });
  std::vector<RunningHypothesis> kept;
  std::size_t of_this = 0;
  for (std::size_t i = 0; i < running_.size(); ++i) {
    of_this = i > 0 && running_[i].hypothesis == running_[i - 1].hypothesis ? of_this + 1 : 0;
    if (of_this >= keep) continue;
    if (second && running_[i].log_likelihood_ratio < best_ratio_ - kHopeless) {
      dropped_.push_back(running_[i]);
      dropped_.back().log_likelihood_ratio -= best_ratio_;
    } else {
      kept.push_back(running_[i]);
    }
  }
  running_ = std::move(kept);
}

std::vector<RunningHypothesis> HypothesisTest::best_of_each() const {
  std::vector<RunningHypothesis> best(bank_.hypotheses().size());
  for (RunningHypothesis& b : best) b.log_likelihood_ratio = -std::numeric_limits<double>::infinity();
  for (RunningHypothesis running : dropped_) {
    running.log_likelihood_ratio += best_ratio_;
    if (better(running, best[running.hypothesis])) best[running.hypothesis] = running;
  }
  for (const RunningHypothesis& running : running_)
    if (better(running, best[running.hypothesis])) best[running.hypothesis] = running;
  return best;
}

std::vector<double> HypothesisTest::excess_ratios() const {
  const RunningHypothesis* piece = work_piece();
  const double changed = is_changed(piece) ? piece->log_likelihood_ratio : 0.0;
  std::vector<double> ratios(bank_.hypotheses().size(), 0.0);
  for (const RunningHypothesis& running : running_)
    ratios[running.hypothesis] = std::max(ratios[running.hypothesis], running.log_likelihood_ratio - changed);
  return ratios;
}

double HypothesisTest::margin() const {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  const auto& hypotheses = bank_.hypotheses();
  std::vector<double> best(hypotheses.size(), kNever);
  for (const RunningHypothesis& gone : dropped_)
    best[gone.hypothesis] = std::max(best[gone.hypothesis], gone.log_likelihood_ratio + best_ratio_);
  for (const RunningHypothesis& running : running_)
    best[running.hypothesis] = std::max(best[running.hypothesis], running.log_likelihood_ratio);
  const auto top = static_cast<std::size_t>(std::max_element(best.begin(), best.end()) - best.begin());
  double second = kNever;
  for (std::size_t h = 0; h < best.size(); ++h)
    if (hypotheses[h].label != hypotheses[top].label) second = std::max(second, best[h]);
  return best[top] - second;
}

const RunningHypothesis* HypothesisTest::likeliest() const {
  const auto best = std::min_element(running_.begin(), running_.end(), better);
  return best == running_.end() ? nullptr : &*best;
}

const RunningHypothesis* HypothesisTest::work_piece() const {
  const RunningHypothesis* best = nullptr;
  for (const RunningHypothesis& running : running_)
    if (bank_.hypotheses()[running.hypothesis].form == HypothesisForm::work_piece &&
        (!best || better(running, *best)))
      best = &running;
  return best;
}

bool HypothesisTest::is_changed(const RunningHypothesis* piece) const {
  return piece && piece->log_likelihood_ratio > options_.threshold;
}

const RunningHypothesis* HypothesisTest::no_fault() const {
  const RunningHypothesis* best = likeliest();
  if (!best || is_misread(bank_.hypotheses()[best->hypothesis])) return best;
  const RunningHypothesis* piece = work_piece();
  return is_changed(piece) && best_counted_ < piece->log_likelihood_ratio + options_.threshold ? piece
                                                                                               : nullptr;
}

/// Whether no fault comes near. Another load than the work piece is one that differs: the next test's to
/// tell.
bool HypothesisTest::clearly_healthy() const {
  const RunningHypothesis* healthy = no_fault();
  if (!healthy) return false;
  const bool piece = bank_.hypotheses()[healthy->hypothesis].form == HypothesisForm::work_piece;
  return std::none_of(running_.begin(), running_.end(), [&](const RunningHypothesis& running) {
    const Hypothesis& hypothesis = bank_.hypotheses()[running.hypothesis];
    if (is_healthy(hypothesis) || (piece && hypothesis.label.kind == FaultKind::payload_change)) return false;
    return counted(running) > healthy->log_likelihood_ratio - options_.clear_margin;
  });
}

bool HypothesisTest::ready() const {
  if (lost_) return true;
  if (now_ - trigger_ > history_.capacity() / 2) return true;
  if (!alarmed())
    return now_ - trigger_ >= kFewestConfirm &&
           history_[now_].time - history_[trigger_].time >= options_.confirm_s;
  const double since_s = history_[now_].time - history_[alarm_].time;
  const bool checked = now_ - alarm_ >= options_.fewest_samples && since_s >= kShortestCheck_s;
  if (checked && clearly_healthy()) return true;
  if (now_ - alarm_ < options_.fewest_samples || since_s < options_.isolate_s) return false;
  return since_s >= options_.longest_isolate_s || (margin() > options_.clear_margin && !lasts_still());
}

/// While a push lasts it explains whatever the robot does: only what comes after it tells it from other
/// faults.
bool HypothesisTest::lasts_still() const {
  const RunningHypothesis* best = likeliest();
  if (!best) return false;
  const Hypothesis& hypothesis = bank_.hypotheses()[best->hypothesis];
  return describe(hypothesis.label.kind).passes &&
         history_[now_].time - best->onset_s < best->duration_s + kOver_s;
}

RunningHypothesis HypothesisTest::refined(const RunningHypothesis& coarse) const {
  return with_refined_onset(bank_, history_, {earliest_, trigger_, now_}, coarse);
}

bool HypothesisTest::was_dropped(int hypothesis) const {
  return std::none_of(running_.begin(), running_.end(),
                      [&](const RunningHypothesis& running) { return running.hypothesis == hypothesis; });
}

HypothesisTest::Conclusion HypothesisTest::conclude() const {
  std::vector<RunningHypothesis> best = best_of_each();
  std::vector<int> order;
  for (std::size_t h = 0; h < best.size(); ++h) order.push_back(static_cast<int>(h));
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return better(best[a], best[b]); });
  for (int i = 0; i < kMostRefined && i < static_cast<int>(order.size()); ++i) {
    const int h = order[i];
    if (best[h].log_likelihood_ratio > best_ratio_ - kWorthRefining)
      best[h] = refined(best[h]);
    else if (std::isfinite(best[h].log_likelihood_ratio) && was_dropped(h))
      best[h].surprise = run(h, best[h].onset).surprise;  // to the end, like that of the others
  }
  Conclusion conclusion;
  EpisodeEvidence& out = conclusion.evidence;
  const RunningHypothesis& winner = *std::min_element(best.begin(), best.end(), better);
  out.best = static_cast<int>(&winner - best.data());
  for (const RunningHypothesis& running : best)
    out.hypotheses.push_back(std::isfinite(running.log_likelihood_ratio) ? bank_.evidence_of(running)
                                                                         : HypothesisEvidence{});
  out.onset_s = winner.onset_s;
  out.alarm_s = history_[alarm_].time;
  out.isolated_s = history_[now_].time;
  out.samples = static_cast<int>(now_ - winner.onset + 1);
  for (std::int64_t k = std::max(winner.onset - kUsualRows, earliest_); k < winner.onset; ++k)
    add_to(out.usual, history_[k], bank_.joints());
  out.trace = trace_evidence(bank_, history_, best, now_);
  for (int j = 0; j < bank_.joints(); ++j)
    out.standstill[j] = standstill_of(bank_.model(), history_, j, winner.onset, now_);
  // Its length tells when it was over; as evidence, a push of any length would explain what is no push.
  conclusion.best = describe(bank_.hypotheses()[out.best].label.kind).passes
                        ? with_refined_duration(bank_, history_, now_, winner)
                        : winner;
  return conclusion;
}

}  // namespace faultline
