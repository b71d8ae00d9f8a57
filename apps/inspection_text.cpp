// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/inspection.hpp"
#include "apps/terminal.hpp"
#include "lib/core/paint.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

/// Extra channels shown before the rest is only counted.
constexpr std::size_t kShownExtra = 12;

std::string head_line(const Inspection& inspection, bool color) {
  const TimeAxis& time = inspection.quality.time;
  std::string line = painted(brief(inspection.log.path), Paint::bold, color) +
                     fmt::format("  {}, {} rows", inspection.log.format, inspection.log.rows_read);
  if (inspection.rows_used != inspection.log.rows_read)
    line += fmt::format(" ({} used)", inspection.rows_used);
  if (!inspection.joint_log) return line + "\n";
  line += fmt::format(", {}, {:.6g} s from {:.10g} to {:.10g} s", counted(inspection.joints, "joint"),
                      time.end_s - time.start_s, time.start_s, time.end_s);
  if (!std::isnan(time.period_s))
    line += fmt::format(", sample period {:.6g} s ({:.5g} Hz)", time.period_s, 1.0 / time.period_s);
  return line + "\n";
}

std::string channel_line(const InspectedChannel& channel) {
  const ChannelSummary& summary = channel.summary;
  const std::string range = summary.values == 0 ? fmt::format("{:>12} {:>12}", "-", "-")
                                                : fmt::format("{:12.6g} {:12.6g}", summary.min, summary.max);
  std::string line = fmt::format("  {:<10} {} {:<14}", shortened(summary.name, kLongestName), range,
                                 shortened(channel.unit, kLongestName));
  if (!channel.column.empty() && channel.column != summary.name)
    line += fmt::format(" from \"{}\"", shortened(channel.column, kLongestName));
  if (summary.missing > 0) line += fmt::format(" {} missing", summary.missing);
  if (summary.constant()) line += " constant";
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string channel_lines(const Inspection& inspection, bool color) {
  std::string text =
      painted(fmt::format("  {:<10} {:>12} {:>12} {}", "channel", "min", "max", "unit"), Paint::dim, color) +
      "\n";
  std::size_t extra = 0;
  for (const InspectedChannel& channel : inspection.channels)
    if (channel.summary.canonical || ++extra <= kShownExtra) text += channel_line(channel);
  if (extra > kShownExtra)
    text += fmt::format("  and {} more columns (--json lists all)\n", extra - kShownExtra);
  return text;
}

Paint paint_of(Severity severity) {
  switch (severity) {
    case Severity::severe:
      return Paint::red;
    case Severity::warning:
      return Paint::yellow;
    case Severity::note:
      return Paint::dim;
  }
  return Paint::dim;
}

std::string issue_line(const Issue& issue, bool color) {
  std::string line =
      "  " + painted(fmt::format("{:<8}", to_string(issue.severity)), paint_of(issue.severity), color);
  line += issue.code;
  if (!issue.channel.empty()) line += " " + shortened(issue.channel, kLongestName);
  if (issue.count > 1) line += fmt::format(", {} times", issue.count);
  if (issue.first_row > 0) line += fmt::format(", first in row {}", issue.first_row);
  if (std::isfinite(issue.first_time_s)) line += fmt::format(" at {:.10g} s", issue.first_time_s);
  if (issue.rows_dropped > 0) line += fmt::format(", {} rows left out", issue.rows_dropped);
  return line + ": " + issue.message + "\n";
}

}  // namespace

std::string inspection_text(const Inspection& inspection, bool color) {
  std::string text = head_line(inspection, color) + channel_lines(inspection, color);
  for (const std::string& lack : inspection.lacking) text += "  lacks " + lack + "\n";
  for (const Issue& issue : inspection.issues.all()) text += issue_line(issue, color);
  if (inspection.issues.empty()) text += "  nothing wrong was found\n";
  return text;
}

}  // namespace faultline
