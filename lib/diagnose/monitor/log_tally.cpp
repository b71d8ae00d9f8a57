// SPDX-License-Identifier: MIT
#include "lib/diagnose/monitor/log_tally.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

constexpr double kHardly = 0.01;  // share of the healthy logs' range: a joint that moves less is at rest

bool can_track(const Log& segment, const Model& model) {
  return std::any_of(model.relations.begin(), model.relations.end(), [&](const SignalRelation& relation) {
    return relation.kind == RelationKind::tracking && has_signals(segment, relation);
  });
}

std::string why_not_judged(const Model& model) {
  const std::string references =
      "has no references (q_ref1.. or dq_ref1..) of joints that follow them according to the model";
  if (!model.has_mechanics())
    return references + ", and the model \"" + model.name +
           "\" was learned from logs without torque; map the columns in [log.columns] of the robot file";
  return "has no torque (tau1..tau" + std::to_string(model.robot.joints()) +
         "), without which this model cannot find faults, and " + references +
         "; map the columns in [log.columns] of the robot file";
}

void check_channels(const Log& segment, const LogSource& log, const Model& model) {
  check_joints(segment, log, model);
  const int joints = model.robot.joints();
  const bool has_torque = static_cast<int>(segment.tau.size()) == joints && model.has_mechanics();
  if (!has_torque && !can_track(segment, model))
    throw Error(ErrorCode::input, log.identity().path, why_not_judged(model));
}

/// The path as given if it is relative, else its file name: a report names no folders of a machine.
std::string shown_path(const std::string& path) {
  const std::filesystem::path given(path);
  return given.is_absolute() ? given.filename().string() : given.generic_string();
}

/// Rows that issues dropped; those of notes do not count, since they are no rows with joint values.
std::int64_t rows_lost(const Issues& issues) {
  std::int64_t rows = 0;
  for (const Issue& issue : issues.all()) rows += issue.severity == Severity::note ? 0 : issue.rows_dropped;
  return rows;
}

}  // namespace

void check_joints(const Log& segment, const LogSource& log, const std::string& whose, int joints) {
  if (segment.joints() != joints)
    throw Error(ErrorCode::input, log.identity().path,
                joint_count_sentence(log.issues(), segment.joints(), whose, joints));
}

void check_joints(const Log& segment, const LogSource& log, const Model& model) {
  check_joints(segment, log, "the model \"" + model.name + "\"", model.robot.joints());
}

int complete_rows(const Log& log) {
  int out = 0;
  for (int k = 0; k < log.rows(); ++k) {
    const auto has = [k](const JointSignals& signals) {
      return std::all_of(signals.begin(), signals.end(),
                         [k](const std::vector<double>& joint) { return std::isfinite(joint[k]); });
    };
    out += has(log.q) && has(log.tau);
  }
  return out;
}

void LogTally::take(const Log& segment, const LogSource& log, const Model& model) {
  check_channels(segment, log, model);
  assess(segment, quality);
  if (facts.rows_used == 0 && segment.rows() > 0) facts.start_s = segment.time.front();
  if (segment.rows() > 0) facts.end_s = segment.time.back();
  facts.rows_used += segment.rows();
  facts.has_velocity = !segment.dq.empty();
  facts.judgeable_rows += complete_rows(segment);
}

/// Returns the joints whose range is less than kHardly of that of the healthy logs.
std::vector<Joint> resting_joints(const LogTally& tally, const Model& model) {
  std::vector<Joint> out;
  if (!model.has_mechanics()) return out;
  const auto [low, high] =
      std::visit([](const auto& robot) { return std::pair(robot.q_low, robot.q_high); }, model.explain.robot);
  for (int j = 0; j < low.size(); ++j) {
    const auto q = std::find_if(
        tally.quality.channels.begin(), tally.quality.channels.end(), [&](const ChannelSummary& channel) {
          return channel.canonical && channel.name == to_string(Channel{Quantity::q, Joint::at(j)});
        });
    if (q != tally.quality.channels.end() && q->max - q->min < kHardly * (high[j] - low[j]))
      out.push_back(Joint::at(j));
  }
  return out;
}

/// Returns by joint the share of the torques that are at the limit of the drive; empty if no limit is known.
std::vector<double> share_at_limit(const LogTally& tally, const std::vector<double>& limit) {
  std::vector<double> out(limit.size(), 0.0);
  for (const ChannelSummary& channel : tally.quality.channels)
    for (std::size_t j = 0; j < limit.size() && channel.canonical; ++j) {
      if (limit[j] == 0.0 || channel.values == 0 ||
          channel.name != to_string(Channel{Quantity::tau, Joint::at(static_cast<int>(j))}))
        continue;
      const std::int64_t above = channel.max >= limit[j] ? channel.at_max : 0,
                         below = channel.min <= -limit[j] ? channel.at_min : 0;
      out[j] = static_cast<double>(above + below) / static_cast<double>(channel.values);
    }
  return out;
}

LogFacts log_facts(const LogSource& log, const LogTally& tally, const Model& model) {
  QualityOptions options;
  options.slides = sliding_joints(model.robot.chain);
  options.runs = log.identity().runs;
  options.stated_units = log.identity().stated_units;
  const LogQuality quality = quality_of(tally.quality, options);
  LogFacts facts = tally.facts;
  facts.path = shown_path(log.identity().path);
  facts.sha256 = log.identity().sha256;
  facts.format = log.identity().format;
  facts.rows_read = log.identity().rows_read;
  facts.sample_period_s = quality.time.period_s;
  facts.joints = model.robot.joints();
  facts.issues = log.issues();
  facts.runs = log.identity().runs;
  facts.resting = resting_joints(tally, model);
  facts.at_limit = share_at_limit(tally, model.robot.torque_limit);
  facts.unjudged = tally.unjudged.stretches();
  facts.rows_unjudged = facts.rows_used - facts.judgeable_rows + rows_lost(facts.issues);
  facts.is_whole = facts.rows_unjudged == 0 && quality.time.gaps == 0;
  facts.issues.merge(quality.issues);
  return facts;
}

}  // namespace faultline
