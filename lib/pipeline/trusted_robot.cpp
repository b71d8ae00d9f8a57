// SPDX-License-Identifier: MIT
#include "lib/pipeline/trusted_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "lib/core/error.hpp"
#include "lib/core/make_issue.hpp"
#include "lib/evidence/survey/survey_log.hpp"
#include "lib/evidence/watch/episode_detector.hpp"
#include "lib/fault/label_text.hpp"

namespace faultline {
namespace {

constexpr double kRobotFirst = 0.6;  // share of the work that is done before logs are doubted
// Nats that a fault may explain of a healthy log before it is worth the time of a robot of its own; the most
// suspicious log is tried whatever they are.
constexpr double kHint = 20.0;

/// A fault that a robot learned from other logs sees in one.
struct Sighting {
  FaultLabel label;
  double onset_s = 0.0;
};

std::optional<Sighting> sight(LogSource& log, const HealthyRobot& others) {
  DelayedTorqueSource in_time = others.reading.of(log);
  const MotionModel& motion = others.model.motion;
  EpisodeDetector detector(motion, others.model.bank, others.model.evidence, survey_noise(in_time, motion));
  in_time.rewind();
  for (Log segment; detector.episodes().empty() && in_time.next(segment);) detector.take(segment);
  detector.finish();
  if (detector.episodes().empty()) return std::nullopt;
  const EpisodeEvidence& first = detector.episodes().front();
  return Sighting{others.model.bank[first.best].label, first.onset_s};
}

/// A log, and the robot of the others that names a fault in it.
struct Contradiction {
  int log = 0;  ///< from 0
  Sighting seen;
  WatchedRobot others;
};

/// Logs given to learn from, by their index from 0, and the robot that those in use make.
class LogTrial {
 public:
  LogTrial(std::span<LogSource* const> logs, const Robot& robot, const WatchedRobotOptions& options)
      : logs_(logs), robot_(robot), options_(options), in_use_(logs.size()) {
    std::iota(in_use_.begin(), in_use_.end(), 0);
  }

  void learn(const Progress& progress) {
    watched_ = watched_robot(logs_, robot_, options_, progress);
    given_ = watched_.robot.given;
    std::erase_if(in_use_, [&](int log) { return given_[log].left_out; });
  }

  /// Leaves out what contradicts the others until nothing does.
  void leave_out_contradicting(const Progress& progress) {
    const std::size_t most = in_use_.size() <= 2 ? 0 : (in_use_.size() - 1) / 2;
    for (std::size_t left_out = 0; left_out < most; ++left_out)
      if (!leave_one_out(progress)) return;
  }

  /// Doubts of two logs, or of logs that are all kept.
  void doubt(const Progress& progress) {
    if (in_use_.size() < 2) return;
    if (const auto found = find_contradiction(progress))
      doubts_.push_back(sentence(found->log, found->seen) + "; it was learned from all the same");
  }

  bool keeps_all() const { return options_.identify.keep_all || in_use_.size() == 2; }

  TrustedRobot result() && {
    HealthyRobot& robot = watched_.robot;
    robot.given = std::move(given_);
    for (Issue& issue : issues_) robot.identification.issues.add(std::move(issue));
    return {std::move(watched_), std::move(doubts_)};
  }

 private:
  /// The most suspicious log in use, and others of which faults explain much, most suspicious first.
  std::vector<int> suspects() const {
    const auto& extremes = watched_.extremes;
    std::vector<int> order(extremes.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return std::pair(extremes[a].largest_ratio(), extremes[a].trigger) >
             std::pair(extremes[b].largest_ratio(), extremes[b].trigger);
    });
    const std::size_t most = in_use_.size() == 2 ? 2 : (in_use_.size() - 1) / 2;
    if (order.size() > most) order.resize(most);
    while (order.size() > 1 && in_use_.size() > 2 && extremes[order.back()].largest_ratio() < kHint)
      order.pop_back();
    for (int& log : order) log = in_use_[log];
    return order;
  }

  std::optional<WatchedRobot> learned_without(int log, const Progress& progress) const {
    if (progress) progress("judging " + given_[log].path + " by the other logs", kRobotFirst);
    std::vector<LogSource*> others;
    for (const int other : in_use_)
      if (other != log) others.push_back(logs_[other]);
    try {
      return watched_robot(others, robot_, options_);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::input) throw;
      return std::nullopt;  // they do not suffice without it
    }
  }

  /// The first suspect in which a robot of the others names a fault.
  std::optional<Contradiction> find_contradiction(const Progress& progress) const {
    for (const int log : suspects()) {
      auto others = learned_without(log, progress);
      if (!others) continue;
      if (const auto seen = sight(*logs_[log], others->robot))
        return Contradiction{log, *seen, std::move(*others)};
    }
    return std::nullopt;
  }

  bool leave_one_out(const Progress& progress) {
    auto found = find_contradiction(progress);
    if (!found) return false;
    issues_.push_back(make_issue(
        fmt::format("suspicious_log_{}", found->log + 1), Severity::warning,
        sentence(found->log, found->seen) +
            "; it was left out. If it is faulty, diagnose it or name its fault with --labels; if it is "
            "healthy, --keep-all learns from it, too"));
    leave_out(found->log, std::move(found->others));
    return true;
  }

  /// Goes on with the robot that the others made, and without what that left out by itself.
  void leave_out(int log, WatchedRobot others) {
    watched_ = std::move(others);
    given_[log].left_out = true;
    std::erase(in_use_, log);
    const std::vector<IdentifiedLog>& given = watched_.robot.given;
    std::vector<int> kept;
    for (std::size_t i = 0; i < in_use_.size(); ++i) {
      given_[in_use_[i]].left_out = given[i].left_out;
      if (!given[i].left_out) kept.push_back(in_use_[i]);
    }
    in_use_ = std::move(kept);
  }

  std::string sentence(int log, const Sighting& seen) const {
    return fmt::format("a robot learned from the other {} shows {} from {:.2f} s on in {}",
                       in_use_.size() == 2 ? "log" : "logs", label_text(seen.label, " at joint "),
                       seen.onset_s, given_[log].path);
  }

  std::span<LogSource* const> logs_;
  const Robot& robot_;
  WatchedRobotOptions options_;
  std::vector<int> in_use_;
  WatchedRobot watched_;
  std::vector<IdentifiedLog> given_;
  std::vector<Issue> issues_;
  std::vector<std::string> doubts_;
};

}  // namespace

TrustedRobot trusted_robot(std::span<LogSource* const> logs, const Robot& robot,
                           const WatchedRobotOptions& options, const Progress& progress) {
  LogTrial trial(logs, robot, options);
  trial.learn(part_of(progress, 0.0, kRobotFirst));
  if (trial.keeps_all())
    trial.doubt(progress);
  else
    trial.leave_out_contradicting(progress);
  return std::move(trial).result();
}

}  // namespace faultline
