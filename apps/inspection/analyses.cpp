// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/inspection/inspection.hpp"

namespace faultline {
namespace {

constexpr double kSlowPeriod_s = 0.1;  // above it accelerations of a robot are not identifiable
constexpr double kCoarsePeriod_s = 0.02;
constexpr double kLeastMotion = 1e-3;  // rad or m
constexpr double kShortLog_s = 5.0;
constexpr std::int64_t kFewRows = 500;
constexpr std::int64_t kFewestRows = 20;

/// The facts that decide, gathered once.
struct Facts {
  const Inspection& inspection;
  std::vector<std::string> torques, motions, references;
  double period_s, span_s;
  bool all_torques = false, moves = false;

  explicit Facts(const Inspection& from)
      : inspection(from),
        period_s(from.quality.time.period_s),
        span_s(from.quality.time.end_s - from.quality.time.start_s) {
    for (const ChannelSummary& channel : from.quality.channels) {
      if (!channel.canonical || channel.values == 0) continue;
      const Quantity quantity = canonical_channel(channel.name)->quantity;
      if (quantity == Quantity::q && channel.max - channel.min > kLeastMotion) moves = true;
      if (quantity == Quantity::tau) torques.push_back(channel.name);
      if (quantity == Quantity::q || quantity == Quantity::dq) motions.push_back(channel.name);
      if (quantity == Quantity::q_ref || quantity == Quantity::dq_ref) references.push_back(channel.name);
    }
    all_torques = static_cast<int>(torques.size()) == from.joints && from.joints > 0;
  }
  bool none() const { return !inspection.joint_log || inspection.rows_used < kFewestRows; }
};

std::vector<std::string> both(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void judge(PossibleAnalysis& analysis, AnalysisFit fit, const std::string& why, const std::string& help) {
  analysis.fit = fit;
  analysis.why = why;
  analysis.help = help;
}

/// Judges the conditions of all analyses that need torques: sets fit, reason and help.
PossibleAnalysis of_torques(const char* name, const char* what, const Facts& facts) {
  PossibleAnalysis analysis{.name = name, .what = what, .channels = both(facts.motions, facts.torques)};
  const std::string log_faster = "log at 50 Hz or more";
  if (!facts.all_torques)
    judge(analysis, AnalysisFit::impossible,
          facts.torques.empty() ? "there is no torque" : "not every joint has a torque",
          "log the torque of every joint, or name it in the robot file: [log.columns] tau1 = {name = .., "
          "scale = .. N m for 1 A}");
  else if (facts.period_s > kSlowPeriod_s)
    judge(analysis, AnalysisFit::impossible,
          fmt::format("a row every {:.3g} s is too coarse to estimate accelerations", facts.period_s),
          log_faster);
  else if (facts.period_s > kCoarsePeriod_s)
    judge(analysis, AnalysisFit::limited,
          fmt::format("a row every {:.3g} s shows little of fast motion", facts.period_s), log_faster);
  else if (facts.inspection.quality.velocity.empty())
    judge(analysis, AnalysisFit::possible, "the velocity is derived from the position",
          "log the drives' velocity, too");
  else
    analysis.fit = AnalysisFit::possible;
  return analysis;
}

PossibleAnalysis identify(const Facts& facts) {
  PossibleAnalysis analysis = of_torques("identify", "identify the robot's parameters", facts);
  if (analysis.fit == AnalysisFit::impossible) return analysis;
  if (!(facts.span_s >= kShortLog_s && facts.inspection.rows_used >= kFewRows))
    judge(analysis, AnalysisFit::limited,
          fmt::format("{} rows in {:.3g} s contain little information about a robot",
                      facts.inspection.rows_used, facts.span_s),
          "give several logs, or one of a minute with all joints moving");
  if (!facts.inspection.quality.velocity.empty() && !facts.moves)
    judge(analysis, AnalysisFit::impossible, "no joint moves", "log a motion that uses all joints");
  return analysis;
}

PossibleAnalysis learn(const Facts& facts, const PossibleAnalysis& identified) {
  PossibleAnalysis analysis = identified;
  analysis.name = "learn";
  analysis.what = "learn a model of the healthy robot";
  if (identified.fit != AnalysisFit::impossible || facts.references.empty()) return analysis;
  analysis.fit = AnalysisFit::limited;
  analysis.channels = both(facts.motions, facts.references);
  analysis.why = identified.why + "; only whether each joint follows its reference can be learned";
  return analysis;
}

PossibleAnalysis tracking(const Facts& facts) {
  PossibleAnalysis analysis{.name = "tracking",
                            .what = "check whether the joints follow their references",
                            .fit = AnalysisFit::possible,
                            .channels = both(facts.motions, facts.references)};
  if (facts.references.empty())
    judge(analysis, AnalysisFit::impossible, "there is no commanded motion", "log q_ref1.. or dq_ref1..");
  return analysis;
}

PossibleAnalysis motion(const Facts& facts) {
  PossibleAnalysis analysis{.name = "motion",
                            .what = "check motion alone: gaps, stuck or contradicting encoders",
                            .fit = AnalysisFit::possible,
                            .channels = facts.motions};
  if (facts.inspection.quality.velocity.empty())
    judge(analysis, AnalysisFit::limited, "there is no velocity to compare the position with",
          "log the drives' velocity, too");
  return analysis;
}

}  // namespace

const char* to_string(AnalysisFit fit) {
  switch (fit) {
    case AnalysisFit::possible:
      return "possible";
    case AnalysisFit::limited:
      return "limited";
    case AnalysisFit::impossible:
      return "impossible";
  }
  return "impossible";
}

std::vector<PossibleAnalysis> possible_analyses(const Inspection& inspection) {
  const Facts facts(inspection);
  const PossibleAnalysis identified = identify(facts);
  std::vector<PossibleAnalysis> all{
      identified, learn(facts, identified),
      of_torques("torque_residuals", "diagnose faults by torque residuals", facts), tracking(facts),
      motion(facts)};
  if (!facts.none()) return all;
  for (PossibleAnalysis& analysis : all) {
    analysis.channels.clear();
    if (inspection.joint_log)
      judge(analysis, AnalysisFit::impossible,
            fmt::format("{} usable rows are too few", inspection.rows_used), "give a longer log");
    else
      judge(analysis, AnalysisFit::impossible, "no time or no position was found",
            "name the columns in a robot file; --suggest writes one to begin with");
  }
  return all;
}

}  // namespace faultline
