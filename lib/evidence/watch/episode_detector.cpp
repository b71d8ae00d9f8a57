// SPDX-License-Identifier: MIT
#include "lib/evidence/watch/episode_detector.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lib/evidence/watch/watch.hpp"

namespace faultline {
namespace {

constexpr std::size_t kMostFaults = 4;  // at a time: beyond, nothing is left to hold the log against
/// Times the usual: a robot with a fault is known less well than a healthy one.
constexpr double kLessKnown = 1.5;
constexpr double kAsGood = 0.5;  // of what a new fault would explain: the end of an old one costs no size
constexpr double kRecent = 0.4;  // of a new row in what was of late: some three rows
constexpr double kOdd = 4.0;     // chi-square of a number in the mean, that no filter leaves which is right

/// Log likelihood of what both filters were asked to explain at this row.
double advantage(const FollowedSample& a, const FollowedSample& b, int joints) {
  double sum = 0.0;
  for (int j = 0; j < joints; ++j)
    if (!a.pressed[j] && !b.pressed[j]) sum += a.log_likelihood[j] - b.log_likelihood[j];
  return sum;
}

/// Chi-square of a measured number at this row, in the mean.
double surprise(const FollowedSample& sample, int joints) {
  double sum = 0.0, count = 0.0;
  for (int j = 0; j < joints; ++j) {
    if (sample.pressed[j]) continue;
    sum += sample.chi_square[j];
    count += std::isfinite(sample.dq[j]) ? 2.0 : 1.0;
  }
  return sum / std::max(count, 1.0);
}

EvidenceOptions less_sure(EvidenceOptions options) {
  options.trigger *= kLessKnown;
  options.threshold *= kLessKnown;
  for (Imitation& imitation : options.imitations) imitation.nats *= kLessKnown;
  return options;
}

}  // namespace

/// A stack of watches: the healthy robot, above it the robot with the first fault that was named, then with
/// the second ... The topmost looks for faults. Those above a level are over when it explains the log better
/// than the topmost does; where one of them took a joint out of sight, when it sees nothing odd for a while.
class EpisodeDetector::Impl {
 public:
  Impl(const MotionModel& model, const std::vector<Hypothesis>& hypotheses, const EvidenceOptions& options,
       const LogNoise& noise)
      : hypotheses_(hypotheses), options_(options), joints_(model.joints()), slow_(model) {
    stack_.push_back({std::make_unique<Watch>(model, hypotheses, options, noise)});
  }

  void take(const Log& segment, int row) {
    for (Level& level : stack_) level.watch->follow(segment, row);
    while (stack_.size() > 1 && !top().watch->is_sound()) end_above(stack_.size() - 2);
    const FollowedSample& sample = top().watch->sample();
    for (std::size_t i = 0; i + 1 < stack_.size(); ++i) stack_[i].watch->move_with(likelier_motion(i));
    if (sample.dt <= 0.0) interrupt();
    last_time_s_ = sample.time;
    if (stack_.size() <= kMostFaults)
      if (auto found = top().watch->look()) open_episode(std::move(*found));
    look_for_ends();
    if (stack_.size() == 1) slow_.take(top().watch->sample().posterior, last_time_s_);
  }

  void interrupt() {
    if (auto found = top().watch->interrupt()) open_episode(std::move(*found));
  }

  const Watch& healthy() const { return *stack_.front().watch; }

  const std::vector<SlowFault>& slow_faults() const { return slow_.faults(); }

  std::vector<EpisodeEvidence> episodes;

 private:
  struct Level {
    std::unique_ptr<Watch> watch;
    std::size_t episode = 0;  ///< whose fault it has more than the level below
    double better = 0.0;      ///< nats by which it has explained the log better than the topmost of late,
    double since_s = -1.0;    ///< and since when
    double odd = 1.0;         ///< chi-square of a number it is shown, of late
  };

  Level& top() { return stack_.back(); }

  void open_episode(HypothesisTest::Conclusion found) {
    if (const std::optional<std::size_t> level = healed(found.best.log_likelihood_ratio)) {
      end_above(*level);
      return;
    }
    const double now_s = last_time_s_;
    const Hypothesis& hypothesis = hypotheses_[found.best.hypothesis];
    episodes.push_back(std::move(found.evidence));
    EpisodeEvidence& episode = episodes.back();
    episode.end_s = now_s;
    if (found.is_over) {
      episode.end_s = episode.isolated_s;
      top().watch->go_on_healed(found.best.onset);
      return;
    }
    if (describe(hypothesis.label.kind).passes) {
      episode.end_s = std::min(now_s, std::max(found.best.onset_s + found.best.duration_s, episode.alarm_s));
      top().watch->go_on_after(found.best);
      return;
    }
    Level level;
    FaultyRobot robot = top().watch->robot();
    const GaussianState state = take_fault(robot, hypothesis, found.best);
    level.watch = std::make_unique<Watch>(*top().watch, std::move(robot), state, less_sure(options_));
    level.episode = episodes.size() - 1;
    for (Level& below : stack_) below.better = 0.0, below.since_s = now_s;
    top().watch->stand_by(found.best.onset);
    stack_.push_back(std::move(level));
  }

  /// The lowest level that explains the log of late: what the topmost takes for another fault, by so many
  /// nats, is the end of one.
  std::optional<std::size_t> healed(double ratio) const {
    for (std::size_t i = 0; i + 1 < stack_.size(); ++i)
      if (stack_[i].better > std::max(options_.clear_margin, kAsGood * ratio) && stack_[i].odd < kOdd)
        return i;
    return std::nullopt;
  }

  void look_for_ends() {
    for (std::size_t i = 0; i + 1 < stack_.size(); ++i) {
      weigh(i);
      const bool over = explains_again(i);
      set_ends_above(i, over);
      if (over) return end_above(i);
    }
  }

  void end_above(std::size_t i) {
    if (stack_[i].better > 0.0)
      for (std::size_t above = i + 1; above < stack_.size(); ++above)
        episodes[stack_[above].episode].end_s = stack_[i].since_s;
    while (stack_.size() > i + 1) stack_.pop_back();
    for (Level& level : stack_) level.better = 0.0;
    top().watch->begin_anew();
  }

  /// Where the joints are, after the topmost or after this one, whichever predicted the row better: while the
  /// fault lasts a level's own motion goes astray.
  const GaussianState& likelier_motion(std::size_t i) {
    const FollowedSample &own = stack_[i].watch->sample(), &other = top().watch->sample();
    const bool own_is = !all_in_sight_above(i) || advantage(own, other, joints_) > 0.0;
    return own_is ? own.posterior : other.posterior;
  }

  bool all_in_sight_above(std::size_t i) const {
    return std::all_of(stack_.begin() + static_cast<std::ptrdiff_t>(i) + 1, stack_.end(),
                       [](const Level& above) { return above.watch->robot().explains; });
  }

  bool is_pressed(const FollowedSample& sample) const {
    return std::any_of(sample.pressed.begin(), sample.pressed.begin() + joints_,
                       [](bool pressed) { return pressed; });
  }

  /// What this row says of level `i` against the topmost; what a joint does that a fault took out of sight is
  /// told by the level alone. While an end stop may hold a joint, nothing is.
  void weigh(std::size_t i) {
    Level& level = stack_[i];
    const FollowedSample& sample = level.watch->sample();
    level.odd += kRecent * (surprise(sample, joints_) - level.odd);
    if (!all_in_sight_above(i)) {
      if (level.watch->suspicious() || level.since_s < 0.0 || is_pressed(sample)) level.since_s = sample.time;
      return;
    }
    if (is_pressed(sample)) return;
    level.better += advantage(sample, top().watch->sample(), joints_);
    if (level.better <= 0.0 || level.odd > kOdd) level.better = 0.0, level.since_s = sample.time;
  }

  /// Whether the faults above level `i` are over.
  bool explains_again(std::size_t i) const {
    const Level& level = stack_[i];
    if (!all_in_sight_above(i)) return level.watch->sample().time - level.since_s > options_.recover_s;
    return level.better > std::max(options_.threshold, kAsGood * stack_.back().watch->ratio());
  }

  /// Faults above level `i` last until this row, or until level `i` began to explain the log.
  void set_ends_above(std::size_t i, bool over) {
    const double end_s = over || !all_in_sight_above(i) ? stack_[i].since_s : stack_[i].watch->sample().time;
    for (std::size_t above = i + 1; above < stack_.size(); ++above)
      episodes[stack_[above].episode].end_s = end_s;
  }

  const std::vector<Hypothesis>& hypotheses_;
  EvidenceOptions options_;
  int joints_;
  std::vector<Level> stack_;
  SlowWatch slow_;
  double last_time_s_ = 0.0;
};

EpisodeDetector::EpisodeDetector(const MotionModel& model, const std::vector<Hypothesis>& hypotheses,
                                 const EvidenceOptions& options, const LogNoise& noise)
    : impl_(std::make_unique<Impl>(model, hypotheses, options, noise)) {}
EpisodeDetector::~EpisodeDetector() = default;

void EpisodeDetector::take(const Log& segment) {
  for (int row = 0; row < segment.rows(); ++row) impl_->take(segment, row);
}

void EpisodeDetector::finish() { impl_->interrupt(); }
const std::vector<EpisodeEvidence>& EpisodeDetector::episodes() const { return impl_->episodes; }
const std::vector<WorkPieceChange>& EpisodeDetector::work_piece_changes() const {
  return impl_->healthy().work_piece_changes();
}
std::vector<SlowEstimate> EpisodeDetector::slow_estimates() const {
  const Watch& healthy = impl_->healthy();
  const GaussianState* const state = healthy.own_state();
  if (state == nullptr) return {};
  const MotionModel& model = healthy.robot().model;
  double work_pieces = 0.0;
  for (const WorkPieceChange& change : healthy.work_piece_changes()) work_pieces += change.kg;
  std::vector<SlowEstimate> estimates;
  for (std::size_t s = 0; s < model.slow.size(); ++s) {
    const int index = 2 * model.joints() + static_cast<int>(s);
    const double carried = model.slow[s].kind == SlowKind::tip_mass ? work_pieces : 0.0;
    estimates.push_back({model.slow[s], state->mean[index] - carried, std::sqrt(state->p(index, index))});
  }
  return estimates;
}

const std::vector<SlowFault>& EpisodeDetector::slow_faults() const { return impl_->slow_faults(); }

int EpisodeDetector::rejected_alarms() const { return impl_->healthy().rejected_alarms(); }
double EpisodeDetector::largest_trigger() const { return impl_->healthy().largest_trigger(); }
double EpisodeDetector::largest_ratio() const { return impl_->healthy().largest_ratio(); }
const std::vector<double>& EpisodeDetector::largest_ratios() const {
  return impl_->healthy().largest_ratios();
}

}  // namespace faultline
