// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/inspection/inspection.hpp"
#include "apps/terminal.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

/// Largest number of extra channels shown; the others are only counted.
constexpr std::size_t kShownExtra = 12;
constexpr std::size_t kInspectionShownGaps = 20;
/// Share of the values at a limit from which on the text mentions it.
constexpr double kToldShare = 0.01;

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

std::string time_line(const Inspection& inspection) {
  const TimeAxis& time = inspection.quality.time;
  if (std::isnan(time.period_s)) return "";
  std::string line =
      fmt::format("  time      jitter {:.3g} s rms, {:.3g} s at most", time.jitter_s, time.largest_jitter_s);
  line += ", " + counted(time.gaps, "gap");
  return line +
         fmt::format("; {:.4g} % of the rows read are used, {:.4g} % of those that the time has room for\n",
                     100.0 * inspection.share_used(), 100.0 * inspection.completeness());
}

std::string gap_lines(const Inspection& inspection) {
  std::string text;
  const auto& gaps = inspection.quality.time.listed_gaps;
  for (std::size_t i = 0; i < gaps.size() && i < kInspectionShownGaps; ++i)
    text += fmt::format("  gap       after row {} at {:.10g} s, {:.4g} s long\n", gaps[i].row,
                        gaps[i].start_s, gaps[i].length_s);
  if (inspection.quality.time.gaps > static_cast<std::int64_t>(kInspectionShownGaps))
    text += fmt::format("  and {} more gaps (--json lists {})\n",
                        inspection.quality.time.gaps - static_cast<std::int64_t>(kInspectionShownGaps),
                        kListedGaps);
  return text;
}

std::string joint_line(const JointCheckup& checkup, Joint joint) {
  std::vector<std::string> words;
  const VelocityRelated& velocity = checkup.velocity;
  if (!std::isnan(velocity.rms_ratio))
    words.push_back(fmt::format("velocity is {:.3g} x the position's change", velocity.rms_ratio));
  if (velocity.is_difference) words.push_back("and was computed from it");
  if (!std::isnan(velocity.delay_rows)) words.push_back(fmt::format("{:.1f} rows late", velocity.delay_rows));
  if (!std::isnan(checkup.torque.correlation))
    words.push_back(fmt::format("torque correlates with acceleration ({:.2f})", checkup.torque.correlation));
  if (!std::isnan(checkup.torque.delay_rows))
    words.push_back(fmt::format("{:.1f} +- {:.1f} rows late", checkup.torque.delay_rows,
                                checkup.torque.delay_uncertainty_rows));
  return words.empty() ? "" : fmt::format("  joint {}   {}\n", joint, fmt::join(words, ", "));
}

std::string analysis_line(const PossibleAnalysis& analysis, bool color) {
  const bool no = analysis.fit == AnalysisFit::impossible, yes = analysis.fit == AnalysisFit::possible;
  std::string line = "  " + painted(no ? "cannot   " : "can      ", no ? Paint::yellow : Paint::dim, color) +
                     " " + analysis.what;
  if (!analysis.why.empty()) line += (no ? ": " : yes ? "; " : ", poorly: ") + analysis.why;
  if (!analysis.help.empty()) line += "; " + analysis.help;
  return line + "\n";
}

std::string course_words(const Inspection& inspection, const ChannelSummary& summary) {
  const ChannelCheckup* found = inspection.checkup_of(summary.name, summary.canonical);
  if (!found) return "";
  std::string words;
  if (found->course.step) words += fmt::format(" step {:.3g}", *found->course.step);
  if (share_at_limits(summary) > kToldShare && !summary.constant())
    words += fmt::format(" {:.2g} % at a limit", 100.0 * share_at_limits(summary));
  return words;
}

std::string channel_line(const InspectedChannel& channel, const Inspection& inspection) {
  const ChannelSummary& summary = channel.summary;
  const std::string range = summary.values == 0 ? fmt::format("{:>12} {:>12}", "-", "-")
                                                : fmt::format("{:12.6g} {:12.6g}", summary.min, summary.max);
  std::string line = fmt::format("  {:<10} {} {:<14}", shortened(summary.name, kLongestName), range,
                                 shortened(channel.unit, kLongestName));
  if (!channel.column.empty() && channel.column != summary.name)
    line += fmt::format(" from \"{}\"", shortened(channel.column, kLongestName));
  if (summary.missing > 0) line += fmt::format(" {} missing", summary.missing);
  if (summary.constant()) line += " constant";
  line += course_words(inspection, summary);
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string channel_lines(const Inspection& inspection, bool color) {
  std::string text =
      painted(fmt::format("  {:<10} {:>12} {:>12} {}", "channel", "min", "max", "unit"), Paint::dim, color) +
      "\n";
  std::size_t extra = 0;
  for (const InspectedChannel& channel : inspection.channels)
    if (channel.summary.canonical || ++extra <= kShownExtra) text += channel_line(channel, inspection);
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

Paint verdict_paint(const Inspection& inspection) {
  if (inspection.severe()) return Paint::red;
  return std::string(verdict_of(inspection)) == "doubtful" ? Paint::yellow : Paint::green;
}

std::string issue_line(const Issue& issue, bool color) {
  return "  " + painted(fmt::format("{:<8}", to_string(issue.severity)), paint_of(issue.severity), color) +
         issue_words(issue, true) + ": " + issue.message + "\n";
}

}  // namespace

std::string inspection_text(const Inspection& inspection, bool color) {
  std::string text = head_line(inspection, color) + "  " +
                     painted(brief(verdict_sentence_of(inspection)), verdict_paint(inspection), color) +
                     "\n" + time_line(inspection) + gap_lines(inspection) + channel_lines(inspection, color);
  for (int j = 0; j < std::ssize(inspection.checkup.joints); ++j)
    text += joint_line(inspection.checkup.joints[j], Joint::at(j));
  for (const std::string& lack : inspection.lacking) text += "  lacks " + lack + "\n";
  for (const Issue& issue : inspection.issues.all()) text += issue_line(issue, color);
  for (const PossibleAnalysis& analysis : inspection.analyses) text += analysis_line(analysis, color);
  return text;
}

}  // namespace faultline
