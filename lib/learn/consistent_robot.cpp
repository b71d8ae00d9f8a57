// SPDX-License-Identifier: MIT
#include "lib/learn/consistent_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "lib/core/error.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/parallel.hpp"
#include "lib/core/statistics.hpp"
#include "lib/fault/fault_kind.hpp"
#include "lib/learn/day_differences.hpp"

namespace faultline {
namespace {

constexpr double kRobotFirst = 0.6;     // share of the work that is done before logs are judged
constexpr double kHint = 5.0;           // nats from which on the most suspicious log is judged by the others
constexpr double kContradictory = 5.0;  // times kLeastEvidence: unusual healthy days give less evidence
constexpr double kSlack = 1.25;         // length of a window over the median length of a healthy log
constexpr double kHealthyKnown = 0.8;   // share of the work that is done when the healthy robot is known

/// Returns the rows with the meaning of the torque and the ranges of days from the robot file.
RobotRows as_stated(RobotRows rows, const Model& model) {
  const bool is_measured = model.robot.log.torque == TorqueMeaning::measured;
  std::visit([&](auto& each) { each.torque_is_measured = is_measured; }, rows);
  return with_stated_ranges(std::move(rows), model.robot.normal, model.motion.torque_scale);
}

/// Length of a window, s: a little longer than the logs that the limits come from, so that a log of their
/// length is one window.
double window_s(const std::vector<UniformLog>& logs) {
  std::vector<double> length_s;
  for (const UniformLog& log : logs) length_s.push_back(log.rows() * log.period_s);
  if (length_s.empty()) return ExplainModel::kLongestWindow_s;
  return std::clamp(kSlack * upper_median(std::move(length_s)), ExplainModel::kShortestWindow_s,
                    ExplainModel::kLongestWindow_s);
}

/// The fault that a robot learned from the other logs finds in a log.
struct Contradiction {
  int log = 0;  ///< from 0
  FaultLabel label;
  double onset_s = 0.0;
};

double strongest(const LogExplanation& e) { return e.best.empty() ? 0.0 : e.best.front().gain; }

/// Returns the log with the strongest evidence of a fault; nullopt if that is below kHint.
std::optional<std::size_t> suspect(const std::vector<LogExplanation>& left_out) {
  std::size_t worst = 0;
  for (std::size_t k = 1; k < left_out.size(); ++k)
    if (strongest(left_out[k]) > strongest(left_out[worst])) worst = k;
  if (left_out.empty() || strongest(left_out[worst]) < kHint) return std::nullopt;
  return worst;
}

class LogTrial {
 public:
  LogTrial(std::span<LogSource* const> logs, const Robot& robot, const ExplainedRobotOptions& options)
      : logs_(logs), robot_(robot), options_(options), in_use_(logs.size()) {
    std::iota(in_use_.begin(), in_use_.end(), 0);
  }

  void learn(const Progress& progress) {
    explained_ = explained_robot(logs_, robot_, options_, progress);
    given_ = explained_.robot.given;
    std::erase_if(in_use_, [&](int log) { return given_[log].left_out; });
  }

  /// Leaves out logs that contradict the others until none does, at most a minority.
  void leave_out_contradicting(const Progress& progress) {
    const std::size_t most = in_use_.size() <= 2 ? 0 : (in_use_.size() - 1) / 2;
    for (std::size_t left_out = 0; left_out < most; ++left_out)
      if (!leave_one_out(progress)) return;
  }

  /// Adds a doubt if one of the logs, which are all kept, contradicts the others.
  void doubt(const Progress& progress) {
    if (in_use_.size() < 2) return;
    const auto found = find_contradiction(progress);
    if (found) explained_.doubts.push_back(sentence(*found) + "; the model was learned from it nevertheless");
  }

  bool keeps_all() const { return options_.identify.keep_all || in_use_.size() == 2; }

  ExplainedRobot result() && {
    HealthyRobot& robot = explained_.robot;
    robot.given = std::move(given_);
    for (Issue& issue : issues_) robot.identification.issues.add(std::move(issue));
    return std::move(explained_);
  }

 private:
  std::optional<ExplainedRobot> learned_without(int log) const {
    std::vector<LogSource*> others;
    for (const int other : in_use_)
      if (other != log) others.push_back(logs_[other]);
    try {
      return explained_robot(others, robot_, options_);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::input) throw;
      return std::nullopt;  // the others do not suffice
    }
  }

  /// Returns the fault in the suspect, if rows learned from the others alone show one. The noise level that
  /// was learned with a faulty log is high, so that its evidence in the first explanation is small.
  std::optional<Contradiction> find_contradiction(const Progress& progress) const {
    const HealthyRobot& robot = explained_.robot;
    const std::optional<std::size_t> found = suspect(explained_.left_out);
    if (!found || robot.days.size() != in_use_.size()) return std::nullopt;
    const int log = in_use_[*found];
    if (progress) progress("judging " + given_[log].path + " by the other logs", kRobotFirst);
    std::vector<LogSource*> others = robot.days;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(*found));
    const ExplainModel model{rows_of(robot, others), scaled(evidence_limits({}), kContradictory)};
    LogSource& suspicious = *robot.days[*found];
    suspicious.rewind();
    const UniformLog rows = uniform_log(suspicious, robot.model.sample_period_s);
    if (!can_explain(rows, model.robot)) return std::nullopt;
    const ExplainedLog seen = explain_whole_log(rows, model);
    if (seen.faults.empty()) return std::nullopt;
    const FaultClaim& first = seen.faults.front().claim;
    return Contradiction{log, {first.kind, first.joint}, first.onset_s};
  }

  bool leave_one_out(const Progress& progress) {
    const auto found = find_contradiction(progress);
    if (!found) return false;
    std::optional<ExplainedRobot> others = learned_without(found->log);
    if (!others) return false;
    issues_.push_back(make_issue(fmt::format("suspicious_log_{}", found->log + 1), Severity::warning,
                                 sentence(*found) +
                                     "; it was left out. If it is faulty, diagnose it or name its fault "
                                     "with --labels; if it is healthy, use it with --keep-all"));
    leave_out(found->log, std::move(*others));
    return true;
  }

  /// Continues with the robot learned from the others, without the logs that its identification left out.
  void leave_out(int log, ExplainedRobot others) {
    explained_ = std::move(others);
    given_[log].left_out = true;
    std::erase(in_use_, log);
    const std::vector<IdentifiedLog>& given = explained_.robot.given;
    std::vector<int> kept;
    for (std::size_t i = 0; i < in_use_.size(); ++i) {
      given_[in_use_[i]].left_out = given[i].left_out;
      if (!given[i].left_out) kept.push_back(in_use_[i]);
    }
    in_use_ = std::move(kept);
  }

  std::string sentence(const Contradiction& found) const {
    return fmt::format("a robot learned from the other {} shows {} from {:.2f} s on in {}",
                       in_use_.size() == 2 ? "log" : "logs", label_text(found.label, " at joint "),
                       found.onset_s, given_[found.log].path);
  }

  std::span<LogSource* const> logs_;
  const Robot& robot_;
  ExplainedRobotOptions options_;
  std::vector<int> in_use_;
  ExplainedRobot explained_;
  std::vector<IdentifiedLog> given_;
  std::vector<Issue> issues_;
};

}  // namespace

ExplainedRobot explained_robot(std::span<LogSource* const> logs, const Robot& robot,
                               const ExplainedRobotOptions& options, const Progress& progress) {
  ExplainedRobot out{healthy_robot(logs, robot, options.identify, part_of(progress, 0.0, kHealthyKnown))};
  if (progress) progress("judging each log by the others", kHealthyKnown);
  HealthyRobot& healthy = out.robot;
  Model& model = healthy.model;
  model.explain.robot = as_stated(std::move(model.explain.robot), model);
  model.labels = labels_of(model.robot);
  std::vector<UniformLog>& uniform = out.logs;
  for (LogSource* day : healthy.days) {
    day->rewind();
    uniform.push_back(uniform_log(*day, model.sample_period_s));
  }
  out.left_out.resize(uniform.size());
  parallel_for(static_cast<int>(uniform.size()), options.threads, [&](int k) {
    const RobotRows others = as_stated(std::move(healthy.without[k]), model);
    if (can_explain(uniform[k], others)) out.left_out[k] = explain_healthy(uniform[k], others);
  });
  model.explain.limits = evidence_limits(out.left_out);
  for (double& limit : model.explain.limits.nats) limit += options.limit_shift;
  model.explain.window_s = window_s(uniform);
  return out;
}

ExplainedRobot consistent_robot(std::span<LogSource* const> logs, const Robot& robot,
                                const ExplainedRobotOptions& options, const Progress& progress) {
  LogTrial trial(logs, robot, options);
  trial.learn(part_of(progress, 0.0, kRobotFirst));
  if (trial.keeps_all())
    trial.doubt(progress);
  else
    trial.leave_out_contradicting(progress);
  return std::move(trial).result();
}

}  // namespace faultline
