// SPDX-License-Identifier: MIT
#include "lib/diagnose/blind_spots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/number_text.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

constexpr double kEnough = 0.75;  // share of the simulated faults of a kind: fewer found are reported

std::string what_is_missing(const UnjudgedStretch& stretch) {
  if (stretch.joint.is_none()) return "rows are missing";
  if (!stretch.lacks_position) return "its torque is missing";
  return stretch.lacks_torque ? "its position and its torque are missing" : "its position is missing";
}

/// The words that a stretch begins with, up to "judged".
std::string not_judged(const UnjudgedStretch& stretch) {
  return stretch.joint.is_none() ? "no joint could be judged"
                                 : fmt::format("joint {} could not be judged", stretch.joint);
}

}  // namespace

std::vector<std::string> blind_spots(TorqueMeaning torque, bool has_velocity) {
  std::vector<std::string> spots;
  if (torque == TorqueMeaning::measured)
    spots.push_back(
        "The logged torque is measured, so it includes a lost or added torque: free-swinging joints and "
        "torque loss cannot be seen.");
  if (torque == TorqueMeaning::current)
    spots.push_back(
        "The logged torque is a motor current: faults between controller and motor current cannot be seen.");
  if (!has_velocity)
    spots.push_back(
        "The log has no velocities: small and short faults are seen later or not at all, and a stuck encoder may be called a "
        "locked joint.");
  return spots;
}

std::string unjudged_words(const UnjudgedStretch& stretch, const LogFacts& log) {
  const double period_s = log.sample_period_s;
  const std::string end = stretch.end_s == log.end_s ? ", the end of the log" : "";
  if (stretch.share < 1.0)
    return fmt::format("{} in {:.0f} % of the time from {} to {}{}: {}, repeatedly", not_judged(stretch),
                       100.0 * stretch.share, time_text(stretch.start_s, period_s),
                       time_text(stretch.end_s, period_s), end,
                       stretch.joint.is_none() ? "rows are missing or empty" : what_is_missing(stretch));
  return fmt::format("{} from {} to {}{}: {}", not_judged(stretch), time_text(stretch.start_s, period_s),
                     time_text(stretch.end_s, period_s), end, what_is_missing(stretch));
}

std::vector<std::string> unjudged_spots(const LogFacts& log) {
  std::vector<std::string> spots;
  const std::size_t listed = std::min<std::size_t>(log.unjudged.size(), 10);  // longer lists are not read
  for (std::size_t i = 0; i < listed; ++i) {
    std::string words = unjudged_words(log.unjudged[i], log);
    words[0] = words[0] == 'j' ? 'J' : 'N';
    spots.push_back(words + ".");
  }
  if (log.unjudged.size() > listed)
    spots.push_back(fmt::format("{} more such stretches could not be judged.", log.unjudged.size() - listed));
  return spots;
}

std::vector<std::string> resting_spots(const LogFacts& log) {
  std::vector<std::string> spots;
  for (const Joint joint : log.resting)
    spots.push_back(fmt::format(
        "Joint {} hardly moved: faults that show in its motion (a lock, friction, a stuck encoder) cannot be seen.",
        joint));
  return spots;
}

std::vector<std::string> torque_limit_spots(const LogFacts& log, const Robot& robot) {
  std::vector<std::string> spots;
  for (std::size_t j = 0; j < log.at_limit.size(); ++j)
    if (log.at_limit[j] > 0.0)
      spots.push_back(fmt::format(
          "In {:.2g} % of the rows more is commanded than the drive of joint {} gives ({:.3g} {}): the torque of the "
          "joint is not judged there.",
          100.0 * log.at_limit[j], Joint::at(static_cast<int>(j)), robot.torque_limit[j],
          torque_unit(robot.chain.geometry[j].kind)));
  return spots;
}

std::vector<std::string> relation_spots(const std::vector<SignalRelation>& relations,
                                        const std::vector<double>& judged_s) {
  std::vector<std::string> spots;
  for (std::size_t i = 0; i < std::min(relations.size(), judged_s.size()); ++i) {
    if (judged_s[i] > 0.0 || relations[i].kind == RelationKind::tracking) continue;
    const bool drive = relations[i].kind == RelationKind::actuator;
    spots.push_back(fmt::format(
        "The healthy logs show how joint {}'s {}, but this log lacks the signals ({}): {} cannot be seen.",
        relations[i].joint,
        drive ? "measured torque follows the commanded one" : "commanded torque follows reference and motion",
        drive ? "commanded and measured torque" : "references, motion and torque",
        drive ? "small faults of the drive" : "faults of the controller and of the source of commands"));
  }
  return spots;
}

std::vector<std::string> drive_limit_spots(const std::vector<SignalRelation>& relations,
                                           const std::vector<double>& beyond_s, const Chain& chain) {
  std::vector<std::string> spots;
  for (std::size_t i = 0; i < std::min(relations.size(), beyond_s.size()); ++i) {
    const SignalRelation& drive = relations[i];
    if (drive.kind != RelationKind::actuator || !(beyond_s[i] > 0.0)) continue;
    spots.push_back(fmt::format(
        "For {1:.2g} s the command of joint {0}, or its rate of change, is outside the range of the healthy "
        "logs, in which the drive gave {2:.3g} to {3:.3g} {4}: whether the drive followed it is not judged.",
        drive.joint, beyond_s[i], drive.low, drive.high,
        torque_unit(chain.geometry[drive.joint.index()].kind)));
  }
  return spots;
}

double power_of(const Validation& validation) {
  double runs = 0.0, detected = 0.0;
  for (const ValidationRow& row : validation.rows) {
    runs += row.runs;
    detected += row.detected;
  }
  return runs > 0.0 ? detected / runs : std::numeric_limits<double>::quiet_NaN();
}

std::vector<std::string> weak_spots(const Validation& validation) {
  std::vector<std::string> spots;
  for (const ValidationRow& row : validation.rows)
    if (row.detected < kEnough * row.runs)
      spots.push_back(fmt::format("Of simulated faults \"{}\" the model finds only {} of {}.",
                                  describe(row.kind).heading, row.detected, row.runs));
  return spots;
}

std::vector<std::string> rough_spots(const std::vector<double>& roughness) {
  std::string joints;
  for (std::size_t j = 0; j < roughness.size(); ++j)
    if (roughness[j] > 1.0)
      joints += fmt::format("{}joint {} {:.2g}", joints.empty() ? "" : ", ", Joint::at(static_cast<int>(j)),
                            roughness[j]);
  if (joints.empty()) return {};
  return {
      fmt::format("The torque residual of this log exceeds that of the learned logs (by the factors: {}). "
                  "The sizes below hold for logs like the learned ones; in this log, faults of these joints "
                  "must be larger by about this factor.",
                  joints)};
}

std::string detectable_size_text(const Detectability& reach, const Chain& chain) {
  const FaultDescription& fault = describe(reach.label.kind);
  if (fault.size_count == 0) return "";
  if (!std::isfinite(reach.size)) return "at any size";
  const bool turns = chain.geometry[reach.label.joint.index()].kind == AxisKind::revolute;
  const SizeMeasure measure = fault.sizes().back().feature;
  if (measure == SizeMeasure::torque_share) return fmt::format("{:.0f} %", 100.0 * reach.size);
  return fmt::format("{:.2g} {}", reach.size, unit_of(measure, turns));
}

std::vector<std::string> detectability_sentences(const std::vector<Detectability>& reach,
                                                 const Chain& chain) {
  std::vector<std::string> sentences;
  for (int k = 0; k < kFaultKinds; ++k) {
    std::string joints;
    for (const Detectability& each : reach) {
      if (each.label.kind != static_cast<FaultKind>(k) || describe(each.label.kind).size_count == 0) continue;
      joints += fmt::format("{}joint {} {}", joints.empty() ? "" : ", ", each.label.joint,
                            detectable_size_text(each, chain));
    }
    if (!joints.empty())
      sentences.push_back(
          fmt::format("Below these sizes, \"{}\" may be missed in a log like the healthy ones: {}.",
                      describe(static_cast<FaultKind>(k)).heading, joints));
  }
  return sentences;
}

}  // namespace faultline
