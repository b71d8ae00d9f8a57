// SPDX-License-Identifier: MIT
#include "lib/report/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/fault_event.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/report/finding_words.hpp"
#include "lib/report/stop_report.hpp"

namespace faultline {
namespace {

constexpr std::size_t kShownPrecedents = 3, kTextShownFeatures = 2;
constexpr std::size_t kInHeadline = 3;  // faults; the timeline and the list show all

std::string sentence(const std::string& text) {
  std::string s = printable(text);
  if (!s.empty() && s[0] >= 'a' && s[0] <= 'z') s[0] = static_cast<char>(s[0] - 'a' + 'A');
  return !s.empty() && s.back() != '.' ? s + "." : s;
}

std::string span_text(const LogFacts& log) {
  return fmt::format("{} to {}, {} rows", time_text(log.start_s, log.sample_period_s),
                     time_text(log.end_s, log.sample_period_s), log.rows_read);
}

std::string period_text(const LogFacts& log) {
  if (!std::isfinite(log.sample_period_s)) return "";
  return fmt::format(", a sample every {} s", value_text(log.sample_period_s));
}

std::string header(const Diagnosis& d, const TimelineOptions& options) {
  std::string text = painted(fmt::format("Log    {}\n", printable(d.log.path)), Paint::bold, options.color);
  text += fmt::format("       {}: {}{}\n", printable(d.log.format), span_text(d.log), period_text(d.log));
  text += fmt::format("Model  {}, faultline {}\n", printable(d.model.name), printable(d.program_version));
  for (const std::string& note : d.model.notes)
    text +=
        painted(wrapped("Note: " + printable(note), "       ", options.width), Paint::yellow, options.color);
  return text;
}

Paint paint_of(Verdict verdict) {
  if (verdict == Verdict::healthy) return Paint::bold_green;
  return verdict == Verdict::faulty ? Paint::bold_red : Paint::yellow;
}

class FaultBlock {
 public:
  FaultBlock(const FaultFinding& fault, const LogFacts& log, const TimelineOptions& options)
      : fault_(fault), log_(log), options_(options) {}

  std::string text() const {
    return title() + times() + opinions() + alternatives() + precedents() + evidence() + next_check();
  }

 private:
  std::string title() const {
    return painted(fmt::format("Fault {}: {}", fault_.id, plain_words(fault_.label)), Paint::bold,
                   options_.color) +
           "\n";
  }

  std::string times() const {
    const double period = log_.sample_period_s;
    return fmt::format("  onset {}   alarm {}   end {}\n", onset_words(fault_, period),
                       clock_words(fault_, fault_.alarm_s, period),
                       clock_words(fault_, fault_.end_s, period));
  }

  std::string opinions() const {
    return fmt::format("  confidence {}: {}\n", percent_text(fault_.confidence), decided_words(fault_)) +
           opinion("MLP", fault_.mlp) + opinion("RBFN", fault_.rbfn);
  }

  static std::string opinion(const char* network, const Opinion& opinion) {
    if (!was_asked(opinion)) return "";
    return fmt::format("    {:<5}{:.2f}  {}\n", network, opinion.confidence, plain_words(opinion.label));
  }

  std::string item(const std::string& text) const {
    std::string lines = wrapped(printable(text), "      ", options_.width);
    if (lines.size() > 4) lines.replace(4, 1, "-");
    return lines;
  }

  std::string alternatives() const {
    std::string text;
    for (const std::string& line : alternative_lines(fault_)) text += item(line);
    return text.empty() ? "" : "  It could also be\n" + text;
  }

  /// A line more below an item.
  std::string more(const std::string& text) const {
    return text.empty() ? "" : wrapped(printable(text), "      ", options_.width);
  }

  std::string precedent(const Precedent& p) const {
    const std::string known = p.origin_text.empty() ? "" : "; " + p.origin_text;
    const std::string done = p.what_was_done.empty() ? "" : "; action taken: " + p.what_was_done;
    return item(fmt::format("case {}, similarity {:.2f}: {}", p.case_id, p.similarity, plain_words(p.label)) +
                known + done) +
           more(likeness_words(p, kTextShownFeatures));
  }

  std::string precedents() const {
    std::string text;
    const std::vector<Precedent> known = known_precedents(fault_);
    const std::size_t shown = std::min<std::size_t>(known.size(), kShownPrecedents);
    for (const Precedent& p : std::span(known).first(shown)) text += precedent(p);
    if (known.size() > shown) text += item(fmt::format("{} more", known.size() - shown));
    if (const std::string words = simulated_precedents_words(fault_); !words.empty()) text += item(words);
    return text.empty() ? "" : "  " + precedents_title(fault_) + "\n" + text;
  }

  std::string evidence() const {
    std::string text;
    for (const std::string& line : evidence_lines(fault_)) text += item(line);
    return text.empty() ? "" : "  Evidence\n" + text;
  }

  std::string next_check() const {
    if (fault_.next_check.empty()) return "";
    return "  Check next\n" + wrapped(printable(fault_.next_check), "    ", options_.width);
  }

  const FaultFinding& fault_;
  const LogFacts& log_;
  const TimelineOptions& options_;
};

std::string residuals_text(const Diagnosis& d) {
  if (d.residuals.empty()) return "";
  std::string text = "Residuals against the regenerated fault-free motion (1 = as in the healthy logs)\n";
  text += "  joint  velocity rms  largest  at            position rms\n";
  for (const auto& row : residual_rows(d))
    text += fmt::format("  {:<7}{:<14}{:<9}{:<14}{}\n", row[0], row[1], row[2], row[3], row[4]);
  return text + "\n";
}

std::string condition(const Diagnosis& d) {
  const std::string text = text_table(condition_table(d));
  return text.empty() ? "" : text + "\n";
}

std::string bullets(const char* title, const std::vector<std::string>& lines, int width) {
  if (lines.empty()) return "";
  std::string text = std::string(title) + "\n";
  for (const std::string& line : lines) text += wrapped(printable(line), "    ", width).replace(2, 1, "-");
  return text + "\n";
}

/// The answer about the stop that was asked about; empty if none was.
std::string stop_block(const Diagnosis& d, const TimelineOptions& options) {
  if (!d.stop) return "";
  const StopAnswer& stop = *d.stop;
  std::string text =
      painted(printable(stop_title(stop, d.log.sample_period_s)), Paint::bold, options.color) + "\n";
  for (const std::string& line : stop.summary)
    text += wrapped(printable(line), "    ", options.width).replace(2, 1, "-");
  text += "\n";
  if (stop.short_log) text += bullets("How much so short a log shows", stop.short_log->notes, options.width);
  const std::string reach = text_table(stop_reach_table(stop));
  if (!reach.empty()) text += reach + "\n";
  return text + bullets("Not looked at", stop.not_looked_at, options.width);
}

/// The faults with the highest confidence first; among equals the earliest.
std::vector<const FaultFinding*> by_confidence(const std::vector<FaultFinding>& faults) {
  std::vector<const FaultFinding*> order;
  for (const FaultFinding& fault : faults) order.push_back(&fault);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto* a, const auto* b) { return a->confidence > b->confidence; });
  return order;
}

std::string headline_of(const FaultFinding& fault, const LogFacts& log) {
  const std::string size = size_words(fault).empty() ? "" : ", " + size_words(fault);
  return fmt::format("{}, from {}{}", plain_words(fault.label), onset_words(fault, log.sample_period_s),
                     size);
}

}  // namespace

std::string verdict_sentence(const Diagnosis& d) {
  if (d.verdict == Verdict::healthy)
    return "No fault found." + (d.verdict_reason.empty() ? "" : " " + sentence(d.verdict_reason));
  if (d.verdict == Verdict::inconclusive) return "No verdict: " + sentence(d.verdict_reason);
  if (d.verdict == Verdict::not_run || d.faults.empty()) return "The log was not diagnosed.";
  const std::vector<const FaultFinding*> order = by_confidence(d.faults);
  if (order.size() == 1) return "1 fault: " + headline_of(*order.front(), d.log) + ".";
  std::string text = fmt::format("{} faults, the most certain first", order.size());
  for (std::size_t i = 0; i < std::min(order.size(), kInHeadline); ++i)
    text += fmt::format("{} {} (confidence {})", i == 0 ? ":" : ";", headline_of(*order[i], d.log),
                        percent_text(order[i]->confidence));
  if (order.size() > kInHeadline) text += fmt::format("; and {} more", order.size() - kInHeadline);
  return text + ".";
}

std::string render_text(const Diagnosis& d, const TimelineOptions& options) {
  std::string text = header(d, options) + "\n";
  text += painted(verdict_sentence(d), paint_of(d.verdict), options.color) + "\n\n";
  const bool judged = d.verdict == Verdict::healthy || !d.faults.empty();
  const std::string timeline = judged ? render_timeline(d, options) : "";
  if (!timeline.empty()) text += timeline + "\n";
  text += stop_block(d, options);
  for (const FaultFinding& fault : d.faults) text += FaultBlock(fault, d.log, options).text() + "\n";
  text += bullets(kSmallChangesTitle, small_change_lines(d), options.width) + condition(d) +
          residuals_text(d) + bullets("Issues of the log", issue_lines(d.log.issues), options.width);
  text += bullets("What this log and model cannot show", d.cannot_see, options.width);
  if (text.ends_with("\n\n")) text.pop_back();
  return text;
}

}  // namespace faultline
