// SPDX-License-Identifier: MIT
#include "lib/identify/motion/log_survey.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

#include "lib/core/make_issue.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/motion/sample_outliers.hpp"
#include "lib/log/difference_velocity.hpp"

namespace faultline {
namespace {

constexpr int kNoiseRows = 1000;       // in the middle of a stretch: enough to estimate a joint's noise
constexpr double kFewRepeats = 0.005;  // of the rows in motion: less changes nothing
constexpr double kCaughtUp = 1.5;      // usual steps after a repeated row: the motion went on meanwhile

/// Steps of q around the rows that repeat the one before, by the joint that moves most there.
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

bool dq_is_difference(const JointMotion& m) {
  auto span = [](const Eigen::VectorXd& v) {
    return std::span<const double>(v.data(), static_cast<std::size_t>(v.size()));
  };
  return is_difference(span(m.time), span(m.q), span(m.dq));
}

/// Rows in the middle of a stretch, enough to tell noise from.
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

/// Rows that repeat the one before are left out of the survey of noise.
void leave_out_repeats(JointMotion& m) {
  for (int k = 1; k < m.rows(); ++k)
    if (m.q[k] == m.q[k - 1] && (m.dq.size() == 0 || m.dq[k] == m.dq[k - 1])) {
      m.q_off[k] = 1;
      if (m.dq.size() > 0) m.dq_off[k] = 1;
    }
}

}  // namespace

LogSurvey survey_log(LogSource& source, int joints) {
  LogSurvey survey;
  std::vector<Busiest> busiest(joints);
  RepeatCounter repeats;
  survey.summary = for_each_raw_stretch(source, joints, RepeatedRows::none, [&](const RawStretch& s) {
    repeats.add(s);
    keep_busiest(s, busiest);
    survey.torque_limits.add(s);
  });
  survey.repeated_rows = repeats.kind();
  survey.repeated_share = repeats.share();
  for (Busiest& b : busiest) {
    if (b.motion.rows() > 0) b.motion = middle_of(b.motion);
    if (b.motion.rows() == 0) {
      survey.dq_is_difference.push_back(0);
      survey.velocity.emplace_back();
      survey.noise.emplace_back();
      continue;
    }
    survey.dq_is_difference.push_back(dq_is_difference(b.motion) ? 1 : 0);
    survey.velocity.emplace_back();
    if (b.motion.dq.size() > 0 && !survey.dq_is_difference.back())
      survey.velocity.back() = velocity_agreement(b.motion);
    if (!survey.measures_velocity(static_cast<int>(survey.velocity.size()) - 1)) b.motion.dq.resize(0);
    if (survey.repeated_rows != RepeatedRows::none) leave_out_repeats(b.motion);
    survey.noise.push_back(fit_motion_noise(b.motion));
  }
  return survey;
}

Issues survey_issues(const LogSurvey& survey) {
  Issues issues = survey.torque_limits.issues();
  const auto note = [&](std::string code, Severity severity, std::string message) {
    issues.add(make_issue(std::move(code), severity, std::move(message)));
  };
  if (survey.repeated_rows != RepeatedRows::none)
    note(
        "repeated_rows", Severity::warning,
        fmt::format("{:.1f} % of the rows in motion repeat the row before; {}", 100.0 * survey.repeated_share,
                    survey.repeated_rows == RepeatedRows::stale
                        ? "their values are old and were left out"
                        : "the motion did not go on meanwhile, so they and their time were taken out"));
  for (std::size_t j = 0; j < survey.velocity.size(); ++j)
    if (survey.velocity[j].disagrees())
      note(fmt::format("velocity_disagrees_{}", j + 1), Severity::severe,
           words(survey.velocity[j], static_cast<int>(j) + 1));
  std::vector<int> derived;
  for (std::size_t j = 0; j < survey.dq_is_difference.size(); ++j)
    if (survey.dq_is_difference[j]) derived.push_back(static_cast<int>(j) + 1);
  if (!derived.empty())
    note("velocity_from_position", Severity::note,
         fmt::format("dq of joint {} is a difference of q: it is no second measurement and was left out",
                     fmt::join(derived, ", ")));
  return issues;
}

}  // namespace faultline
