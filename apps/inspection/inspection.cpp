// SPDX-License-Identifier: MIT
#include "apps/inspection/inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/columns/unit_fit.hpp"
#include "lib/log/mapped_source.hpp"
#include "lib/log/recorder/corrected_source.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

/// Added to the verdict, which is on the recording: a faulty run may be recorded well.
constexpr const char* kNotOfTheRobot = "; `faultline diagnose` judges whether the robot has a fault";

auto number_of(const Issues& issues, Severity severity) {
  const auto& all = issues.all();
  return std::count_if(all.begin(), all.end(),
                       [severity](const Issue& issue) { return issue.severity == severity; });
}

const char* unit_of(Quantity quantity, AxisKind axis) {
  if (quantity == Quantity::time) return "s";
  if (is_torque(quantity)) return torque_unit(axis);
  return basic_quantity(quantity) == Quantity::q ? position_unit(axis) : velocity_unit(axis);
}

/// Returns the unit of a channel; the units of both kinds of axis if no robot with that joint is given.
std::string unit_of(Channel channel, const std::optional<Robot>& robot) {
  const Quantity quantity = channel.quantity;
  if (quantity == Quantity::time || (robot && channel.joint.index() < robot->joints()))
    return unit_of(quantity,
                   channel.joint.is_none() ? AxisKind{} : robot->chain.geometry[channel.joint.index()].kind);
  return std::string(unit_of(quantity, AxisKind::revolute)) + " or " + unit_of(quantity, AxisKind::prismatic);
}

std::string column_of(const ChannelSummary& channel, const Matching& matching,
                      const std::vector<RawColumn>& columns) {
  if (!channel.canonical) return channel.name;
  for (const ChannelSource& source : matching.channels)
    if (to_string(source.channel) == channel.name)
      return source.column >= 0 ? columns[source.column].name : kRowNumberName;
  return "";
}

std::vector<std::string> what_is_lacking(const Log& log) {
  std::vector<std::string> lacking;
  if (log.tau.empty())
    lacking.push_back("torque: without it only the motion can be judged, and no robot can be identified");
  if (log.dq.empty()) lacking.push_back("velocity: it will be derived from the position");
  return lacking;
}

void judge_dropped_rows(Inspection& inspection) {
  std::int64_t dropped = inspection.issues.rows_dropped();
  for (const char* meant : {"row_of_other_signals", "other_run"})
    for (const Issue& issue : inspection.issues.all())
      if (issue.code == meant) dropped -= issue.rows_dropped;
  if (100 * dropped <= inspection.log.rows_read) return;
  inspection.issues.add({"many_rows_dropped", "", Severity::severe,
                         fmt::format("{} of {} rows could not be used", dropped, inspection.log.rows_read)});
}

void judge_robot(Inspection& inspection, const std::optional<Robot>& robot) {
  if (!robot || robot->joints() == inspection.joints) return;
  inspection.issues.add(
      {"other_robot", "", Severity::severe,
       fmt::format("the log has positions of {} joints, but the robot file has {} axes; check if it is a "
                   "log of another robot, or if a column is not mapped",
                   inspection.joints, robot->joints())});
}

Inspection inspect_joint_log(MappedSource& mapped, const std::vector<RawColumn>& columns,
                             const std::optional<Robot>& robot, const Progress& progress) {
  Inspection inspection;
  QualityState state;
  Checkup checkup;
  OverviewPass overview;
  const bool is_its_robot = robot && robot->joints() == mapped.matching().joints;
  const auto source = corrected(mapped, is_its_robot ? sliding_joints(robot->chain) : std::vector<bool>{});
  Log segment;
  while (source->next(segment)) {
    assess(segment, state);
    checkup.add(segment);
    overview.add(segment);
    inspection.rows_used += segment.rows();
    if (inspection.lacking.empty()) inspection.lacking = what_is_lacking(segment);
    if (progress) progress("reading " + source->identity().path, source->share_read());
  }
  inspection.joint_log = true;
  inspection.joints = mapped.matching().joints;
  inspection.log = source->identity();
  QualityOptions options;
  if (is_its_robot) options.slides = sliding_joints(robot->chain);
  options.runs = source->identity().runs;
  options.stated_units = source->identity().stated_units;
  inspection.quality = quality_of(state, options);
  inspection.issues = source->issues();
  inspection.issues.merge(inspection.quality.issues);
  inspection.checkup = checkup.result();
  inspection.overview = overview.result();
  inspection.issues.merge(checkup_issues(inspection.checkup, inspection.quality));
  judge_dropped_rows(inspection);
  judge_robot(inspection, robot);
  for (const ChannelSummary& channel : inspection.quality.channels) {
    const auto canonical = channel.canonical ? canonical_channel(channel.name) : std::nullopt;
    inspection.channels.push_back({channel, column_of(channel, mapped.matching(), columns),
                                   canonical ? unit_of(*canonical, robot) : channel.unit});
  }
  inspection.analyses = possible_analyses(inspection);
  return inspection;
}

/// Converts a block of raw columns to a log with extra channels only and the row number as time.
void as_extra(RawBlock& block, const std::vector<RawColumn>& columns, Log& log) {
  log.first_row = block.first_row;
  log.time.resize(block.rows);
  for (int i = 0; i < block.rows; ++i) log.time[i] = static_cast<double>(block.first_row + i);
  log.extra.resize(columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    log.extra[c].name = columns[c].name;
    log.extra[c].unit = columns[c].unit;
    log.extra[c].values.swap(block.columns[c]);
  }
}

/// Returns the estimated sample period of a table without a clock as an addition to a message; may be empty.
std::string words_of(const RowClock& clock) {
  const auto estimate = clock.estimate();
  if (!estimate) return "";
  return fmt::format(
      ". According to q and dq, a row is {:.4g} +- {:.1g} s after the one before: t = {{name = \"@row\", "
      "scale = {:.4g}}}",
      estimate->period_s, estimate->std_s, estimate->period_s);
}

Inspection inspect_table(RawReader& reader, const ColumnMap& map) {
  Inspection inspection;
  const std::string& path = reader.identity().path;
  RowClock clock(reader.columns(), map, path);
  QualityState state;
  RawBlock block;
  Log log;
  while (reader.next(block, 4096)) {
    inspection.rows_used += block.rows;
    clock.add(block);
    as_extra(block, reader.columns(), log);
    assess(log, state);
  }
  inspection.why_not = why_no_match(reader.columns(), map, path) + words_of(clock);
  inspection.log = reader.identity();
  for (Issue issue : reader.issues().all()) {
    if (issue.code == "not_a_number") issue.severity = Severity::note;  // a table may have columns of text
    inspection.issues.add(issue);
  }
  inspection.issues.add({"no_joint_log", "", Severity::severe, inspection.why_not});
  for (const ChannelSummary& channel : state.channels)
    inspection.channels.push_back({channel, channel.name, channel.unit});
  inspection.analyses = possible_analyses(inspection);
  return inspection;
}

}  // namespace

bool Inspection::severe() const { return number_of(issues, Severity::severe) > 0; }

double Inspection::share_used() const {
  return log.rows_read > 0 ? static_cast<double>(rows_used) / static_cast<double>(log.rows_read)
                           : std::nan("");
}

double Inspection::completeness() const { return faultline::completeness(quality.time); }

const ChannelCheckup* Inspection::checkup_of(const std::string& channel, bool canonical) const {
  const auto known = canonical ? canonical_channel(channel) : std::nullopt;
  return known ? checkup.find(*known) : nullptr;
}

const char* verdict_of(const Inspection& inspection) {
  if (!inspection.joint_log) return "no_joint_log";
  if (inspection.severe()) return "damaged";
  return number_of(inspection.issues, Severity::warning) > 0 ? "doubtful" : "sound";
}

std::string verdict_sentence_of(const Inspection& inspection) {
  const std::string verdict = verdict_of(inspection);
  if (verdict == "no_joint_log") return "no joint log: no time or no position was found in it";
  const bool for_all = std::none_of(
      inspection.analyses.begin(), inspection.analyses.end(), [](const PossibleAnalysis& analysis) {
        return analysis.name == "torque_residuals" && analysis.fit == AnalysisFit::impossible;
      });
  if (verdict == "sound")
    return std::string(for_all ? "the recording is sound: nothing is wrong with its data"
                               : "the recording is sound, but not suitable for every analysis") +
           kNotOfTheRobot;
  const auto severe = number_of(inspection.issues, Severity::severe),
             warned = number_of(inspection.issues, Severity::warning);
  if (verdict == "doubtful")
    return fmt::format("the recording is usable with care: {}{}", counted(warned, "warning"), kNotOfTheRobot);
  return fmt::format("look at the recording before you use it: {}{}", counted(severe, "severe finding"),
                     warned > 0 ? ", " + counted(warned, "warning") : "");
}

std::string issue_words(const Issue& issue, bool with_time) {
  std::string words = issue.code;
  if (!issue.channel.empty()) words += " " + shortened(issue.channel, kLongestName);
  if (issue.count > 1) words += fmt::format(", {} times", issue.count);
  if (issue.first_row > 0) words += fmt::format(", first in row {}", issue.first_row);
  if (with_time && std::isfinite(issue.first_time_s))
    words += fmt::format(" at {:.10g} s", issue.first_time_s);
  if (issue.rows_dropped > 0) words += fmt::format(", {} rows left out", issue.rows_dropped);
  return words;
}

Inspection inspect_columns(std::unique_ptr<RawReader> reader, const std::optional<Robot>& robot,
                           const Progress& progress, int run) {
  MappedSourceOptions options;
  if (robot && !reader->canonical()) options.columns = robot->log.columns;
  options.run = run;
  const auto columns = reader->columns();
  if (!why_no_match(columns, options.columns, reader->identity().path).empty())
    return inspect_table(*reader, options.columns);
  MappedSource source(std::move(reader), options);
  return inspect_joint_log(source, columns, robot, progress);
}

Inspection inspect_log(const std::string& path, const std::optional<Robot>& robot, const Progress& progress,
                       const LogSelection& parts) {
  return inspect_columns(open_parts(path, parts, robot ? robot->log.recording : RecordingChoice{}), robot,
                         progress, parts.run);
}

}  // namespace faultline
