// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/fault_event.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/report/finding_words.hpp"
#include "lib/report/html/elements.hpp"
#include "lib/report/html/page_figures.hpp"

namespace faultline {
namespace {

constexpr const char* kWordsLink =
    "<p class=\"sub\"><a class=\"words\" href=\"#words\">What these words mean</a></p>\n";
constexpr std::size_t kShownFaults = 12;  // in the table, before it is scrolled

std::string times(const FaultFinding& f, double period_s) {
  const HtmlRow cells = fault_cells(f, period_s);
  return html_table({"onset", "alarm", "end", "confidence", "decided by"},
                    {HtmlRow(cells.begin() + 2, cells.end())}, fmt::format("Fault {}", f.id));
}

std::vector<HtmlRow> feature_rows(const char* likeness, const std::vector<PrecedentFeature>& features) {
  std::vector<HtmlRow> rows;
  for (const PrecedentFeature& f : features)
    rows.push_back({likeness, f.what, feature_value_text(f.here, f.unit), feature_value_text(f.there, f.unit),
                    fmt::format("{:.2g}", f.difference)});
  return rows;
}

std::string likeness(const Precedent& p) {
  std::vector<HtmlRow> rows = feature_rows("alike", p.alike);
  for (HtmlRow& row : feature_rows("unlike", p.unlike)) rows.push_back(std::move(row));
  if (rows.empty()) return "";
  return fmt::format(
      "<details><summary>Why case {} is similar</summary>\n{}</details>\n", p.case_id,
      html_table({"likeness", "in", "here", "there", "difference"}, rows, fmt::format("Case {}", p.case_id)));
}

std::string precedent_table(const std::vector<Precedent>& cases, const std::string& caption) {
  std::vector<HtmlRow> rows;
  std::string why;
  for (const Precedent& p : cases) {
    rows.push_back(precedent_cells(p));
    why += likeness(p);
  }
  if (!why.empty())
    why += "<p class=\"sub\">A difference of 1 is usual between cases of the same fault.</p>\n";
  return html_table({"case", "similarity", "fault", "origin", "action taken"}, rows, caption) + why;
}

/// Those that people or labelled logs stated, then the simulated ones in one line that opens.
std::string precedents(const FaultFinding& f) {
  std::string text = precedent_table(known_precedents(f), precedents_title(f));
  if (const std::string words = simulated_precedents_words(f); !words.empty())
    text += fmt::format("<details><summary>{}</summary>\n{}</details>\n", escaped_markup(words),
                        precedent_table(simulated_precedents(f), "Simulated cases"));
  return text;
}

std::string learn_more(FaultKind kind) {
  const std::string text = describe(kind).learn_more;
  if (text.empty()) return "";
  return "\n<details><summary>Learn more: how this fault shows in a log</summary>\n<p>" +
         escaped_markup(text) + "</p></details>\n";
}

std::string column(const std::string& content) {
  return content.empty() ? "" : "<div>\n" + content + "</div>\n";
}

}  // namespace

std::string html_plots(const std::vector<PageFigure>& figures, int fault_id, double sample_period_s) {
  if (figures.empty()) return "";
  std::string text =
      fmt::format("<div>\n<div class=\"tools\" data-fault=\"{}\"></div>\n<div class=\"plots\">\n", fault_id);
  for (const PageFigure& figure : figures) text += html_figure(figure, sample_period_s);
  return text + "</div>\n</div>\n";
}

std::string html_finding(const FaultFinding& f, const std::vector<PageFigure>& figures, double period_s) {
  std::string text = fmt::format("<section class=\"finding\" id=\"fault-{0}\">\n<h2>Fault {0}: {1}</h2>\n",
                                 f.id, escaped_markup(plain_words(f.label)));
  if (const std::string size = size_words(f); !size.empty())
    text += "<p class=\"size\">Size: " + escaped_markup(size) + ".</p>\n";
  text += times(f, period_s);
  if (!f.next_check.empty())
    text += "<div class=\"check\"><h3>Check next</h3>\n" + escaped_markup(f.next_check) +
            learn_more(f.label.kind) + "</div>\n";
  text += html_plots(figures, f.id, period_s);
  text += "<div class=\"columns\">\n";
  text += column(html_part("It could also be", html_list(alternative_lines(f))));
  text += column(html_part("Evidence", html_list(evidence_lines(f)) + kWordsLink));
  text +=
      column(html_part("Outputs of both networks", html_table({"network", "names", "confidence"},
                                                              opinion_rows(f), "Outputs of both networks")));
  text += "</div>\n" + html_part(precedents_title(f).c_str(), precedents(f));
  return text + "</section>\n";
}

std::string html_fault_link(const FaultFinding& f, double zero_s) {
  const std::string place = f.id <= kFullFindings ? fmt::format("fault-{}", f.id) : "faults";
  return fmt::format("href=\"#{}\" data-fault=\"{}\" data-onset=\"{}\"", place, f.id, f.onset_s - zero_s);
}

std::string html_fault_table(const Diagnosis& d) {
  if (d.faults.empty()) return "";
  const double zero_s = time_zero(d.log.start_s);
  const HtmlRow heads = {"fault", "what", "onset", "alarm", "end", "confidence"};
  std::string text = fmt::format(
      "<div class=\"wide{}\" id=\"faults\"><table{}>\n<caption><span class=\"unseen\">All faults</span>"
      "</caption>\n<thead><tr>",
      d.faults.size() > kShownFaults ? " tall\" tabindex=\"0\" role=\"region\" aria-label=\"All faults" : "",
      html_table_class(heads.size()));
  for (const std::string& head : heads) text += fmt::format("<th scope=\"col\">{}</th>", head);
  text += "</tr></thead>\n<tbody>\n";
  for (const FaultFinding& f : d.faults) {
    text += fmt::format("<tr><td data-label=\"fault\"><a {}>{}</a></td>", html_fault_link(f, zero_s), f.id);
    const HtmlRow cells = fault_cells(f, d.log.sample_period_s);
    for (std::size_t i = 1; i < heads.size(); ++i)
      text += fmt::format("<td data-label=\"{}\">{}</td>", heads[i], escaped_markup(cells[i]));
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

}  // namespace faultline
