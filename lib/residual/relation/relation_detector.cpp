// SPDX-License-Identifier: MIT
#include "lib/residual/relation/relation_detector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>

#include "lib/log/log.hpp"
namespace faultline {
namespace {

constexpr double kStillDeviates = 0.5;  // share of the allowed mean above which an episode goes on
constexpr double kEpisodeGap_s = 0.1;   // time below it after which an episode is over
constexpr double kOfItsLength = 0.5;    // of the limit: a smaller mean of a short episode is a shift in time
constexpr double kJolt_s = 0.3;         // length below which an episode is short
// Least share of the residual that a lost share of the command explains, and largest ratio of its residual to
// that of a constant.
constexpr double kShareExplains = 0.5, kBetterThanOffset = 0.5;
constexpr double kAtFirst_s = 0.3;  // beginning of an episode that is described by itself
constexpr double kQuiet = 1.5;      // times the rms before the episode, below which the deviation is over
constexpr double kQuiet_s = 0.08;   // time for which it must be: current loops settle sooner
constexpr int kFewestQuiet = 20;    // rows for an estimate of that rms, at least
constexpr double kLookBack = 1.5;   // windows before the alarm in which the onset is searched

std::vector<double> lengths_of(const SignalRelation& relation) {
  std::vector<double> lengths;
  for (const WindowLimit& window : relation.windows) lengths.push_back(window.window_s);
  return lengths;
}

}  // namespace

void RelationSums::add(const RelationSample& sample) {
  residual += sample.residual;
  square += sample.residual * sample.residual;
  product += sample.residual * sample.predicted;
  predicted_square += sample.predicted * sample.predicted;
  low = std::min(low, sample.predicted + sample.residual);
  high = std::max(high, sample.predicted + sample.residual);
  predicted_low = std::min(predicted_low, sample.predicted);
  predicted_high = std::max(predicted_high, sample.predicted);
  reference_low = std::min(reference_low, sample.reference);
  reference_high = std::max(reference_high, sample.reference);
  const double target = sample.predicted + sample.residual;
  target_square += target * target;
  reference_square += sample.reference * sample.reference;
  ++rows;
}

RelationDetector::RelationDetector(const SignalRelation& relation)
    : relation_(relation),
      residual_(relation),
      means_(window_rows(lengths_of(relation), relation.period_s)),
      predicted_(means_),
      by_speed_(means_),
      quiet_(window_rows(std::array{kQuiet_s}, relation.period_s)),
      quiet_squares_(quiet_) {}

void RelationDetector::take(const Log& segment) {
  if (!has_signals(segment, relation_)) return;
  look_for_changes(segment);
  for (int k = 0; k < segment.rows(); ++k) {
    if (const auto sample = residual_.take(segment, k)) judge(*sample);
  }
}

void RelationDetector::look_for_changes(const Log& segment) {
  const auto changes = [&](Quantity quantity, double& first) {
    const std::vector<double>& values = signals_of(segment, quantity)[relation_.joint.index()];
    return std::any_of(values.begin(), values.end(), [&](double value) {
      if (std::isnan(first)) first = value;
      return std::isfinite(value) && value != first;
    });
  };
  target_moves_ = target_moves_ || changes(relation_.target, first_target_);
  input_moves_ = input_moves_ || changes(relation_.inputs.front(), first_input_);
}

void RelationDetector::finish() {
  if (now_) close(true);
  if (is_connected()) return;
  episodes_.clear();
  judged_rows_ = 0;
}

/// Whether the channels are connected: a channel that never changes is not. In tracking, a joint may stand
/// still if its reference moves, or if it stands at its reference.
bool RelationDetector::is_connected() const {
  if (relation_.kind != RelationKind::tracking) return target_moves_ && input_moves_;
  return input_moves_ || (!target_moves_ && episodes_.empty());
}

void RelationDetector::judge(const RelationSample& sample) {
  ++judged_rows_;
  means_.add(sample.residual, sample.time);
  predicted_.add(std::abs(sample.predicted), sample.time);
  by_speed_.add(std::abs(sample.by_speed), sample.time);
  quiet_.add(sample.residual, sample.time);
  quiet_squares_.add(sample.residual * sample.residual, sample.time);
  recent_.push_back(sample);
  const auto longest = static_cast<std::size_t>(means_.rows(static_cast<int>(relation_.windows.size()) - 1));
  if (recent_.size() > 2 * longest) recent_.pop_front();
  const LargestMean largest_mean = farthest();
  if (now_)
    go_on(sample, largest_mean);
  else if (largest_mean.times > 1.0)
    open(sample, largest_mean);
}

double RelationDetector::allowed(int window) const {
  return allowed_mean(relation_, window, predicted_.mean(window), by_speed_.mean(window));
}

/// Limit of a mean over about as many rows as the sums have, in the target's unit.
double RelationDetector::allowed_over(const RelationSums& sums) const {
  int window = 0;
  while (window + 1 < static_cast<int>(relation_.windows.size()) && means_.rows(window + 1) <= sums.rows)
    ++window;
  return relation_.windows[window].limit;
}

RelationDetector::LargestMean RelationDetector::farthest() const {
  LargestMean largest_mean;
  for (int w = 0; w < means_.full(); ++w) {
    const double times = std::abs(means_.mean(w)) / allowed(w);
    if (times > largest_mean.times) largest_mean = {w, times};
  }
  return largest_mean;
}

/// Index in recent_ at which an offset that lasts until now most likely began.
std::size_t RelationDetector::onset_in(int window) const {
  const auto back = static_cast<std::size_t>(kLookBack * means_.rows(window));
  const std::size_t first = recent_.size() - std::min(recent_.size(), std::max<std::size_t>(back, 1));
  double sum = 0.0, best = 0.0;
  std::size_t at = recent_.size() - 1;
  for (std::size_t i = recent_.size(); i-- > first;) {
    sum += recent_[i].residual;
    const double gain = sum * sum / static_cast<double>(recent_.size() - i);
    if (gain > best) best = gain, at = i;
  }
  return at;
}

/// Root mean square of the rows in recent_ before the onset; the previous value if they are too few, as right
/// after another episode.
double RelationDetector::quiet_rms_before(std::size_t onset) const {
  if (onset < kFewestQuiet) return quiet_rms_;
  double square = 0.0;
  for (std::size_t i = 0; i < onset; ++i) square += recent_[i].residual * recent_[i].residual;
  return std::sqrt(square / static_cast<double>(onset));
}

/// Whether the residual was as before the episode for kQuiet_s: also its rms, since its mean passes zero when
/// it changes its sign.
bool RelationDetector::is_quiet_again() const {
  return quiet_.full() > 0 && std::sqrt(quiet_squares_.mean(0)) < kQuiet * quiet_rms_ &&
         std::abs(quiet_.mean(0)) < kStillDeviates * allowed(0) && says_something();
}

void RelationDetector::open(const RelationSample& sample, const LargestMean& largest_mean) {
  const std::size_t onset = onset_in(largest_mean.window);
  quiet_rms_ = quiet_rms_before(onset);
  now_ = RelationEpisode{.kind = relation_.kind, .joint = relation_.joint, .target = relation_.target};
  now_->onset_s = recent_[onset].time;
  now_->alarm_s = sample.time;
  window_ = largest_mean.window;
  peak_ = 0.0;
  since_onset_ = {};
  normal_rows_ = 0;
  for (std::size_t i = onset; i + 1 < recent_.size(); ++i) since_onset_.add(recent_[i]);
  now_->at_first = since_onset_;
  go_on(sample, largest_mean);
}

void RelationDetector::go_on(const RelationSample& sample, const LargestMean& largest_mean) {
  since_onset_.add(sample);
  if (sample.time - now_->onset_s < kAtFirst_s) now_->at_first = since_onset_;
  if (largest_mean.times > 1.0 && largest_mean.window < window_) {
    window_ = largest_mean.window;
    peak_ = 0.0;
  }
  peak_ = std::max(peak_, std::abs(means_.mean(window_)));
  if (largest_mean.times > now_->times_limit) {
    const double z = means_.mean(largest_mean.window) / relation_.windows[largest_mean.window].std;
    now_->times_limit = largest_mean.times;
    now_->strongest = means_.mean(largest_mean.window);
    now_->nats = 0.5 * z * z;
  }
  if (sample.time - now_->alarm_s > kQuiet_s && is_quiet_again()) {
    now_->end_s = std::max(std::min(sample.time - kQuiet_s, now_->end_s), now_->onset_s);
    close(false);
  } else if (std::abs(means_.mean(window_)) >= kStillDeviates * allowed(window_)) {
    now_->end_s = sample.time;
    deviating_ = since_onset_;
    normal_rows_ = 0;
  } else if (says_something() && ++normal_rows_ * relation_.period_s > kEpisodeGap_s) {
    now_->end_s = end_of(now_->end_s);
    close(false);
  }
}

/// Whether the deviation would be detected if it went on: not while a window fills after a pause, nor, if a
/// share of the command is missing, while little is commanded.
bool RelationDetector::says_something() const {
  if (means_.full() <= window_) return false;
  const RelationSums& s = deviating_;
  if (!(s.predicted_square > 0.0 && s.square > 0.0 && s.rows > 0)) return true;
  const double by_share = s.share_explains();
  const double by_offset = s.residual * s.residual / (static_cast<double>(s.rows) * s.square);
  const bool is_share = by_share > kShareExplains && 1.0 - by_share < kBetterThanOffset * (1.0 - by_offset);
  const double expected = std::abs(s.share()) * predicted_.mean(window_);
  return !is_share || expected > allowed(window_);
}

/// Estimates the end of the deviation: the mean over a window deviates for some time after it, the longer,
/// the larger it was.
double RelationDetector::end_of(double last_s) const {
  const double still = kStillDeviates * relation_.windows[window_].limit;
  const double late_s = relation_.windows[window_].window_s * (1.0 - std::min(still / peak_, 1.0));
  return std::max(last_s - late_s, now_->onset_s + relation_.period_s);
}

void RelationDetector::close(bool lasts) {
  if (!lasts) now_->end_s = std::max(now_->end_s, now_->alarm_s);
  RelationEpisode episode = *now_;
  now_.reset();
  for (WindowedMeans* means : {&means_, &predicted_, &by_speed_, &quiet_, &quiet_squares_}) means->restart();
  recent_.clear();
  episode.lasts = lasts;
  const double rows = std::max((episode.end_s - episode.onset_s) / relation_.period_s + 1.0, 1.0);
  episode.mean = deviating_.residual / rows;
  if (deviating_.square > 0.0)
    episode.offset_explains = episode.mean * episode.mean * rows / deviating_.square;
  episode.share = deviating_.share();
  episode.share_explains = deviating_.share_explains();
  const bool is_long = episode.end_s - episode.onset_s > kJolt_s;
  if (is_long || std::abs(episode.mean) > kOfItsLength * allowed_over(deviating_))
    episodes_.push_back(episode);
}

}  // namespace faultline
