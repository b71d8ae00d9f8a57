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

/// Judges the conditions of all analyses that need torques: sets fit, reason and help.
void judge_torques(const Facts& facts, PossibleAnalysis& analysis) {
  analysis.channels = both(facts.motions, facts.torques);
  if (!facts.all_torques) {
    analysis.why = facts.torques.empty() ? "there is no torque" : "not every joint has a torque";
    analysis.help =
        "log the torque of every joint, or name it in the robot file: [log.columns] tau1 = {name = .., "
        "scale = .. N m for 1 A}";
    return;
  }
  if (facts.period_s > kSlowPeriod_s) {
    analysis.why =
        fmt::format("a row every {:.3g} s is too coarse to estimate accelerations", facts.period_s);
    analysis.help = "log at 50 Hz or more";
    return;
  }
  analysis.fit = AnalysisFit::possible;
  if (facts.period_s > kCoarsePeriod_s) {
    analysis.fit = AnalysisFit::limited;
    analysis.why = fmt::format("a row every {:.3g} s shows little of fast motion", facts.period_s);
    analysis.help = "log at 50 Hz or more";
  } else if (!facts.inspection.quality.velocity.size()) {
    analysis.why = "the velocity is derived from the position";
    analysis.help = "log the drives' velocity, too";
  }
}

void judge_length(const Facts& facts, PossibleAnalysis& analysis) {
  if (analysis.fit == AnalysisFit::impossible) return;
  if (facts.span_s >= kShortLog_s && facts.inspection.rows_used >= kFewRows) return;
  analysis.fit = AnalysisFit::limited;
  analysis.why = fmt::format("{} rows in {:.3g} s contain little information about a robot",
                             facts.inspection.rows_used, facts.span_s);
  analysis.help = "give several logs, or one of a minute with all joints moving";
}

PossibleAnalysis identify(const Facts& facts) {
  PossibleAnalysis analysis{"identify", "identify the robot's parameters", {}, {}, {}, {}};
  judge_torques(facts, analysis);
  judge_length(facts, analysis);
  if (analysis.fit != AnalysisFit::impossible && !facts.inspection.quality.velocity.empty() && !facts.moves) {
    analysis.fit = AnalysisFit::impossible;
    analysis.why = "no joint moves";
    analysis.help = "log a motion that uses all joints";
  }
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

PossibleAnalysis torque_residuals(const Facts& facts) {
  PossibleAnalysis analysis{"torque_residuals", "diagnose faults by torque residuals", {}, {}, {}, {}};
  judge_torques(facts, analysis);
  return analysis;
}

PossibleAnalysis tracking(const Facts& facts) {
  PossibleAnalysis analysis{"tracking", "check whether the joints follow their references", {}, {}, {}, {}};
  analysis.channels = both(facts.motions, facts.references);
  if (facts.references.empty()) {
    analysis.why = "there is no commanded motion";
    analysis.help = "log q_ref1.. or dq_ref1..";
  } else {
    analysis.fit = AnalysisFit::possible;
  }
  return analysis;
}

PossibleAnalysis motion(const Facts& facts) {
  PossibleAnalysis analysis{"motion", "check motion alone: gaps, stuck or contradicting encoders", {}, {}, {},
                            {}};
  analysis.channels = facts.motions;
  analysis.fit = AnalysisFit::possible;
  if (!facts.inspection.quality.velocity.empty()) return analysis;
  analysis.fit = AnalysisFit::limited;
  analysis.why = "there is no velocity to compare the position with";
  analysis.help = "log the drives' velocity, too";
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
  std::vector<PossibleAnalysis> all{identified, learn(facts, identified), torque_residuals(facts),
                                    tracking(facts), motion(facts)};
  if (!facts.none()) return all;
  for (PossibleAnalysis& analysis : all) {
    analysis.fit = AnalysisFit::impossible;
    analysis.channels.clear();
    analysis.why = inspection.joint_log ? fmt::format("{} usable rows are too few", inspection.rows_used)
                                        : "no time or no position was found";
    analysis.help = inspection.joint_log
                        ? "give a longer log"
                        : "name the columns in a robot file; --suggest writes one to begin with";
  }
  return all;
}

}  // namespace faultline
