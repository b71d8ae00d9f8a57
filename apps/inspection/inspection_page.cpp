// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/inspection/inspection.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/report/html/elements.hpp"

namespace faultline {
namespace {

constexpr std::size_t kShownGaps = 20;
constexpr std::size_t kShownChannels = 200;

/// Returns the colour of the verdict, as in reports.
const char* colour_of(const Inspection& inspection) {
  const std::string verdict = verdict_of(inspection);
  return verdict == "sound" ? "healthy" : verdict == "doubtful" ? "inconclusive" : "faulty";
}

/// `level`: 1 for the heading of the log on a page of one log, 2 on a page of several.
std::string heading(int level, const std::string& text) {
  return fmt::format("<h{0}>{1}</h{0}>\n", level, escaped_markup(text));
}

std::string top(const Inspection& inspection, int level) {
  const TimeAxis& time = inspection.quality.time;
  std::string facts = fmt::format("{}, {} rows, {} used", inspection.log.format, inspection.log.rows_read,
                                  inspection.rows_used);
  if (inspection.joint_log)
    facts += fmt::format(", {}, {} to {}", counted(inspection.joints, "joint"),
                         time_text(time.start_s, time.period_s), time_text(time.end_s, time.period_s));
  if (!std::isnan(time.period_s)) facts += fmt::format(", {:.5g} Hz", 1.0 / time.period_s);
  std::string verdict = verdict_sentence_of(inspection);
  if (!verdict.empty()) verdict[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(verdict[0])));
  return fmt::format("{}<p class=\"sub\">{}</p>\n<p class=\"verdict {}\">{}</p>\n",
                     heading(level, printable(inspection.log.path)), escaped_markup(facts),
                     colour_of(inspection), escaped_markup(brief(verdict)));
}

/// Returns an item of a list: severity or fit, subject, then the sentence.
std::string item(const std::string& word, const std::string& what, const std::string& sentence) {
  return fmt::format("<li><b>{}</b> {}{}{}</li>\n", escaped_markup(word), escaped_markup(what),
                     sentence.empty() ? "" : ": ", escaped_markup(sentence));
}

std::string findings(const Inspection& inspection, int level) {
  std::vector<Issue> issues = inspection.issues.all();
  std::stable_sort(issues.begin(), issues.end(),
                   [](const Issue& a, const Issue& b) { return a.severity > b.severity; });
  std::string text;
  for (const Issue& issue : issues)
    text += item(to_string(issue.severity), issue_words(issue, false), issue.message);
  return heading(level + 1, "Findings") +
         (text.empty() ? "<p>No problems were found.</p>\n" : "<ul>\n" + text + "</ul>\n");
}

std::string analyses(const Inspection& inspection, int level) {
  std::string text;
  for (const PossibleAnalysis& analysis : inspection.analyses) {
    std::string sentence = analysis.why;
    if (!analysis.help.empty()) sentence += "; " + analysis.help;
    if (!analysis.channels.empty())
      sentence += fmt::format("{}from {}", sentence.empty() ? "" : "; ", fmt::join(analysis.channels, ", "));
    text += item(to_string(analysis.fit), analysis.what, sentence);
  }
  return heading(level + 1, "Possible analyses") + "<ul>\n" + text + "</ul>\n";
}

std::string time_facts(const Inspection& inspection, int level) {
  const TimeAxis& time = inspection.quality.time;
  if (std::isnan(time.period_s)) return "";
  std::string text =
      heading(level + 1, "Time") +
      html_table(
          {},
          {{"sample period (median)", fmt::format("{:.6g} s", time.period_s)},
           {"jitter", fmt::format("{:.3g} s rms, {:.3g} s at most", time.jitter_s, time.largest_jitter_s)},
           {"gaps", fmt::format("{}, {:.4g} s together", time.gaps, time.in_gaps_s)},
           {"rows used of those read", fmt::format("{:.4g} %", 100.0 * inspection.share_used())},
           {"rows recorded of those that the time has room for",
            fmt::format("{:.4g} %", 100.0 * inspection.completeness())}},
          "Time");
  std::vector<HtmlRow> gaps;
  for (std::size_t i = 0; i < std::min(time.listed_gaps.size(), kShownGaps); ++i)
    gaps.push_back({std::to_string(time.listed_gaps[i].row),
                    time_text(time.listed_gaps[i].start_s, time.period_s),
                    fmt::format("{:.4g} s", time.listed_gaps[i].length_s)});
  const bool all = time.gaps <= static_cast<std::int64_t>(kShownGaps);
  return text + html_table(FactTable{all ? "Gaps" : "The first gaps", {"after row", "at", "length"}, gaps});
}

std::string step_text(const ChannelCheckup* found) {
  return found && found->course.step ? value_text(*found->course.step) : "";
}

std::string unchanged_text(const ChannelCheckup* found) {
  if (!found || found->course.longest.rows < 2) return "";
  const SameValue& same = found->course.longest;
  return fmt::format("{} rows at {}", same.rows, value_text(same.value));
}

std::string channels(const Inspection& inspection, int level) {
  std::vector<HtmlRow> rows;
  for (const InspectedChannel& channel : inspection.channels) {
    if (rows.size() == kShownChannels) break;
    const ChannelSummary& summary = channel.summary;
    const ChannelCheckup* found = inspection.checkup_of(summary.name, summary.canonical);
    const bool any = summary.values > 0;
    rows.push_back({shortened(summary.name, kLongestName), shortened(channel.column, kLongestName),
                    shortened(channel.unit, kLongestName), any ? value_text(summary.min) : "-",
                    any ? value_text(summary.max) : "-", std::to_string(summary.missing), step_text(found),
                    unchanged_text(found), fmt::format("{:.2g} %", 100.0 * share_at_limits(summary))});
  }
  return heading(level + 1, "Channels") + html_table({"channel", "column", "unit", "least", "largest",
                                                      "missing", "step", "longest unchanged", "at a limit"},
                                                     rows, "Channels");
}

std::string joints(const Inspection& inspection) {
  std::vector<HtmlRow> rows;
  for (int j = 0; j < std::ssize(inspection.checkup.joints); ++j) {
    const auto& [velocity, torque] = inspection.checkup.joints[j];
    rows.push_back({fmt::format("{}", Joint::at(j)), value_text(velocity.rms_ratio),
                    value_text(velocity.delay_rows), velocity.is_difference ? "yes" : "no",
                    value_text(torque.correlation), value_text(torque.delay_rows)});
  }
  return html_table(FactTable{"Velocity against the position's change, torque against acceleration",
                              {"joint", "velocity, times", "velocity late, rows", "computed from position",
                               "torque's correlation", "torque late, rows"},
                              rows});
}

}  // namespace

std::string inspection_page(const std::vector<Inspection>& inspections) {
  std::string text = html_head(inspections.size() == 1 ? printable(inspections[0].log.path).substr(0, 200)
                                                       : counted(std::ssize(inspections), "log"),
                               false) +
                     "<body>\n<main>\n";
  const int level = inspections.size() > 1 ? 2 : 1;
  if (inspections.size() > 1) text += fmt::format("<h1>{}</h1>\n", counted(std::ssize(inspections), "log"));
  for (std::size_t i = 0; i < inspections.size(); ++i) {
    const Inspection& inspection = inspections[i];
    const std::string figures = inspection_figures(inspection, fmt::format("log{}-", i + 1));
    text += top(inspection, level) + findings(inspection, level) + analyses(inspection, level);
    if (!figures.empty())
      text += heading(level + 1, "The channels") +
              "<p class=\"sub\">Shaded: gaps, and times at which a channel did not change although its "
              "joint moved.</p>\n" +
              figures;
    text += time_facts(inspection, level) + channels(inspection, level) + joints(inspection);
    text += heading(level + 1, "Provenance") +
            html_table({}, {{"log SHA-256", inspection.log.sha256}}, "Provenance");
  }
  return text + "</main>\n</body>\n</html>\n";
}

}  // namespace faultline
