// SPDX-License-Identifier: MIT
#include "lib/evidence/listener.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lib/evidence/bank.hpp"
#include "lib/evidence/history.hpp"
#include "lib/evidence/judgement.hpp"
#include "lib/evidence/trigger.hpp"

namespace faultline {

/// Sleeping: the follower and the trigger run. Judging: the bank runs too. Ailing: a fault was named and the
/// log still looks faulty; only its end is watched for.
class Listener::Impl {
 public:
  Impl(const MotionModel& model, const std::vector<Hypothesis>& hypotheses, const EvidenceOptions& options)
      : options_(options),
        follower_(model),
        trigger_(model),
        bank_(model, follower_.dynamics(), hypotheses),
        history_(kHistory) {}

  void take(const Log& segment, int row, std::vector<EpisodeEvidence>& episodes) {
    FollowedSample& sample = history_.push();
    follower_.follow(segment, row, sample);
    if (sample.dt <= 0.0) {
      interrupt(episodes);
      restart_ = history_.last();
    }
    const double statistic = trigger_.take(sample);
    const int repeats = trigger_.repeated_codes();
    const bool suspicious = statistic > options_.trigger || repeats >= kSuspiciousRepeats;
    switch (mode_) {
      case Mode::sleeping:
        sleep(sample, statistic, repeats, suspicious);
        break;
      case Mode::judging:
        judge(episodes);
        break;
      case Mode::ailing:
        ail(sample, suspicious, episodes);
        break;
    }
    last_time_s_ = sample.time;
    last_row_ = sample.row;
  }

  void finish(std::vector<EpisodeEvidence>& episodes) { interrupt(episodes); }

  int rejected_alarms = 0;
  double largest_trigger = 0.0;
  double largest_ratio = 0.0;

 private:
  enum class Mode { sleeping, judging, ailing };
  static constexpr int kHistory = 4096;
  static constexpr int kRearm = 64;

  void sleep(const FollowedSample& sample, double statistic, int repeats, bool suspicious) {
    // A statistic that a rejected suspicion already looked into is old news until it grows or decays.
    if (sample.row < rearm_row_ && statistic < 1.3 * looked_into_ && repeats != kSuspiciousRepeats) return;
    largest_trigger = std::max(largest_trigger, statistic);
    if (statistic < 0.7 * options_.trigger) follower_.learn_range(sample);
    if (!suspicious) return;
    looked_into_ = statistic;
    judgement_.emplace(bank_, history_, options_, restart_, repeats);
    mode_ = Mode::judging;
  }

  void judge(std::vector<EpisodeEvidence>& episodes) {
    judgement_->advance();
    if (judgement_->ready()) conclude(history_.back().time, history_.back().row, episodes);
  }

  /// Names the fault, or lets the suspicion go when its evidence did not last.
  void conclude(double time_s, std::int64_t row, std::vector<EpisodeEvidence>& episodes) {
    const GaussianState* misread = judgement_->misread();
    if (misread) follower_.restore(*misread);
    if (misread || !judgement_->alarmed() || judgement_->best_ratio() < options_.threshold) {
      rejected_alarms += judgement_->alarmed();
      if (!judgement_->alarmed()) largest_ratio = std::max(largest_ratio, judgement_->largest_ratio());
      rearm_row_ = row + kRearm;
      mode_ = Mode::sleeping;
    } else {
      episodes.push_back(judgement_->evidence());
      episodes.back().end_s = last_faulty_s_ = time_s;
      mode_ = Mode::ailing;
    }
    judgement_.reset();
  }

  void ail(const FollowedSample& sample, bool suspicious, std::vector<EpisodeEvidence>& episodes) {
    if (suspicious) episodes.back().end_s = last_faulty_s_ = sample.time;
    if (sample.time - last_faulty_s_ > options_.recover_s) mode_ = Mode::sleeping;
  }

  /// The filter started anew (a gap) or the log ended: what is open is decided with what there is.
  void interrupt(std::vector<EpisodeEvidence>& episodes) {
    if (mode_ == Mode::judging) conclude(last_time_s_, last_row_, episodes);
    mode_ = Mode::sleeping;
  }

  EvidenceOptions options_;
  Follower follower_;
  Trigger trigger_;
  Bank bank_;
  History history_;
  Mode mode_ = Mode::sleeping;
  std::optional<Judgement> judgement_;
  double last_faulty_s_ = 0.0;
  double last_time_s_ = 0.0;
  std::int64_t last_row_ = 0;
  std::int64_t restart_ = 0;  ///< number of the sample at which the filter last started anew
  double looked_into_ = 0.0;
  std::int64_t rearm_row_ = -1;
};

Listener::Listener(const MotionModel& model, const std::vector<Hypothesis>& hypotheses,
                   const EvidenceOptions& options)
    : impl_(std::make_unique<Impl>(model, hypotheses, options)) {}
Listener::~Listener() = default;

void Listener::listen(const Log& segment, std::vector<EpisodeEvidence>& episodes) {
  for (int row = 0; row < segment.rows(); ++row) impl_->take(segment, row, episodes);
}

void Listener::finish(std::vector<EpisodeEvidence>& episodes) { impl_->finish(episodes); }
int Listener::rejected_alarms() const { return impl_->rejected_alarms; }
double Listener::largest_trigger() const { return impl_->largest_trigger; }
double Listener::largest_ratio() const { return impl_->largest_ratio; }

}  // namespace faultline
