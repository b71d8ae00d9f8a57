// SPDX-License-Identifier: MIT
#include "lib/identify/motion/log_survey.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "lib/core/issue.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/motion/raw_stretch.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/derived_velocity.hpp"

namespace faultline {
namespace {

constexpr int kNoiseRows = 1000;       // in the middle of a stretch: enough to estimate a joint's noise
constexpr double kFewRepeats = 0.005;  // of the rows in motion: fewer repeats change nothing
constexpr double kCaughtUp = 1.5;      // usual steps after a repeated row: the motion went on meanwhile

/// Of the rows at an extreme value: more show a torque limit. A few clipped rows change no fit.
constexpr double kLimitShare = 0.04;

/// Compares the steps of q before and after repeated rows, of the joint that moves most there.
class RepeatCounter {
 public:
  void add(const RawStretch& s) {
    for (int k = 2; k + 1 < s.rows(); ++k) {
      Eigen::Index joint = 0;
      const Eigen::VectorXd before = s.q.col(k - 1) - s.q.col(k - 2), after = s.q.col(k + 1) - s.q.col(k);
      if (before.cwiseAbs().maxCoeff(&joint) == 0.0 || after[joint] == 0.0) continue;
      ++moving_;
      if (!same(s, k)) continue;
      ratios_.push_back(after[joint] / before[joint]);
    }
  }
  double share() const {
    const auto repeats = static_cast<double>(ratios_.size());
    return moving_ > 0 ? repeats / (moving_ + repeats) : 0.0;
  }
  RepeatedRows kind() const {
    if (share() < kFewRepeats) return RepeatedRows::none;
    return upper_median(ratios_) > kCaughtUp ? RepeatedRows::stale : RepeatedRows::extra;
  }

 private:
  static bool same(const RawStretch& s, int k) {
    return s.q.col(k) == s.q.col(k - 1) && s.tau.col(k) == s.tau.col(k - 1) &&
           (s.dq.size() == 0 || s.dq.col(k) == s.dq.col(k - 1));
  }

  int moving_ = 0;
  std::vector<double> ratios_;
};

bool dq_is_derived(const JointMotion& m) {
  auto span = [](const Eigen::VectorXd& v) {
    return std::span<const double>(v.data(), static_cast<std::size_t>(v.size()));
  };
  return is_derived(span(m.time), span(m.q), span(m.dq));
}

/// Returns rows in the middle of a stretch, enough to estimate noise.
JointMotion middle_of(const JointMotion& m) {
  const int rows = std::min(m.rows(), kNoiseRows), begin = (m.rows() - rows) / 2;
  JointMotion out;
  out.time = m.time.segment(begin, rows);
  out.q = m.q.segment(begin, rows);
  out.q_off = m.q_off.segment(begin, rows);
  if (m.dq.size() == 0) return out;
  out.dq = m.dq.segment(begin, rows);
  out.dq_off = m.dq_off.segment(begin, rows);
  return out;
}

/// The stretch in which one joint moves most.
struct Busiest {
  double travel = -1.0;
  JointMotion motion;
};

void keep_busiest(const RawStretch& s, std::vector<Busiest>& busiest) {
  for (int j = 0; j < s.joints(); ++j) {
    const Eigen::Index n = s.rows();
    const double travel = (s.q.row(j).tail(n - 1) - s.q.row(j).head(n - 1)).cwiseAbs().sum();
    if (travel <= busiest[j].travel) continue;
    busiest[j] = {travel, joint_motion(s, j)};
  }
}

/// Excludes rows that repeat the row before from the estimate of the noise.
void leave_out_repeats(JointMotion& m) {
  for (int k = 1; k < m.rows(); ++k)
    if (m.q[k] == m.q[k - 1] && (m.dq.size() == 0 || m.dq[k] == m.dq[k - 1])) {
      m.q_off[k] = 1;
      if (m.dq.size() > 0) m.dq_off[k] = 1;
    }
}

/// Compares by the change of position over windows, which neither noise nor a smoother bends. `motion` must
/// have a velocity.
VelocityAgreement velocity_agreement(const JointMotion& motion) {
  const auto values = [](const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); };
  std::vector<double> q = values(motion.q), dq = values(motion.dq);
  for (int k = 0; k < motion.rows(); ++k)
    if (motion.q_off[k] || motion.dq_off[k]) q[k] = dq[k] = std::nan("");
  VelocityCheck check;
  check.add(values(motion.time), q, dq);
  return check.result();
}

/// Adds an issue if the torque never changes, or is at a limit that is not known in many rows: a command
/// beyond the limit is not the torque that moved the robot.
void judge_torque(const ChannelSummary& torque, bool limit_is_known, Issues& issues) {
  if (torque.constant()) {
    issues.add(make_issue("constant_torque", Severity::warning,
                          torque.name + " never changes: check that it is the right column", torque.name));
    return;
  }
  if (limit_is_known) return;
  const auto rows = static_cast<double>(torque.values);
  for (const auto& [limit, times] : {std::pair{torque.max, torque.at_max}, {torque.min, torque.at_min}})
    if (static_cast<double>(times) > kLimitShare * rows && limit != 0.0)
      issues.add(
          make_issue("torque_limit", Severity::warning,
                     fmt::format("{} is at its limit of {:g} in {:.0f} % of the rows: a torque clipped by "
                                 "the drive or by the log is not the torque that moved the robot",
                                 torque.name, limit, 100.0 * static_cast<double>(times) / rows),
                     torque.name));
}

}  // namespace

std::string other_unit_text(const VelocityAgreement& agreement, Joint joint) {
  return fmt::format("dq{0} is {1:.4g} times the derivative of q{0}: {2}; dq{0} was left out", joint,
                     1.0 / agreement.factor, velocity_guess(agreement.factor, false, false));
}

LogSurvey survey_log(LogSource& source, int joints) {
  LogSurvey survey;
  std::vector<Busiest> busiest(joints);
  RepeatCounter repeats;
  for (int j = 0; j < joints; ++j)
    survey.torque.push_back({.name = to_string({Quantity::tau, Joint::at(j)})});
  survey.summary = for_each_raw_stretch(source, joints, RepeatedRows::none, [&](const RawStretch& s) {
    repeats.add(s);
    keep_busiest(s, busiest);
    for (int j = 0; j < joints; ++j)
      for (const double tau : s.tau.row(j)) survey.torque[j].add(tau);
  });
  survey.repeated_rows = repeats.kind();
  survey.repeated_share = repeats.share();
  for (Busiest& b : busiest) {
    survey.dq_is_derived.push_back(0);
    survey.velocity.emplace_back();
    survey.noise.emplace_back();
    if (b.motion.rows() == 0) continue;
    survey.dq_is_derived.back() = dq_is_derived(b.motion) ? 1 : 0;
    if (b.motion.dq.size() > 0 && !survey.dq_is_derived.back())
      survey.velocity.back() = velocity_agreement(b.motion);
    if (!survey.measures_velocity(static_cast<int>(survey.velocity.size()) - 1)) b.motion.dq.resize(0);
    b.motion = middle_of(b.motion);
    if (survey.repeated_rows != RepeatedRows::none) leave_out_repeats(b.motion);
    survey.noise.back() = fit_motion_noise(b.motion);
  }
  return survey;
}

Issues survey_issues(const LogSurvey& survey, const std::vector<double>& known_limit) {
  Issues issues;
  for (std::size_t j = 0; j < survey.torque.size(); ++j)
    judge_torque(survey.torque[j], j < known_limit.size() && known_limit[j] > 0.0, issues);
  const auto note = [&](std::string code, Severity severity, std::string message) {
    issues.add(make_issue(std::move(code), severity, std::move(message)));
  };
  if (survey.repeated_rows != RepeatedRows::none)
    note("repeated_rows", Severity::warning,
         fmt::format(
             "{:.1f} % of the rows in motion repeat the row before; {}", 100.0 * survey.repeated_share,
             survey.repeated_rows == RepeatedRows::stale
                 ? "their values are outdated and were left out"
                 : "the motion did not continue during them, so these rows and their time were removed"));
  for (int j = 0; j < std::ssize(survey.velocity); ++j)
    if (survey.velocity[j].is_other_unit())
      note(fmt::format("velocity_disagrees_{}", Joint::at(j)), Severity::severe,
           other_unit_text(survey.velocity[j], Joint::at(j)));
  std::vector<int> derived;
  for (std::size_t j = 0; j < survey.dq_is_derived.size(); ++j)
    if (survey.dq_is_derived[j]) derived.push_back(static_cast<int>(j) + 1);
  if (!derived.empty())
    note(
        "velocity_from_position", Severity::note,
        fmt::format(
            "dq of joint {} is computed from q (a difference, or filtered and late), not a measurement of its "
            "own; it was left out",
            fmt::join(derived, ", ")));
  return issues;
}

}  // namespace faultline
