// SPDX-License-Identifier: MIT
#include "lib/report/html/report_formats.hpp"

#include <algorithm>

#include "lib/core/error.hpp"
#include "lib/report/html/html_report.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

template <std::string (*render)(const Diagnosis&)>
std::string from_diagnosis(const ReportSource& source) {
  return render(source.diagnosis);
}

std::string page(const ReportSource& source) { return render_html(source.diagnosis, source.details()); }

}  // namespace

const std::vector<ReportFormat>& report_formats() {
  static const std::vector<ReportFormat> table{
      {"json", ".json", "the diagnosis as JSON", false, from_diagnosis<render_json>},
      {"csv", ".csv", "one row a fault as CSV", false, from_diagnosis<render_csv>},
      {"html", ".html", "a page to look at: plots, evidence, similar cases, provenance", true, page},
      {"md", ".md", "Markdown for an issue tracker", false, from_diagnosis<render_markdown>},
      {"junit", ".xml", "JUnit XML for a CI server", false, from_diagnosis<render_junit>},
  };
  return table;
}

const ReportFormat& report_format(std::string_view name) {
  const auto& table = report_formats();
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const ReportFormat& format) { return format.name == name; });
  if (found == table.end()) throw Error(ErrorCode::internal, std::string(name), "is not a report format");
  return *found;
}

ReportSource report_source(LogSource& log, const Model& model, const Diagnosis& diagnosis,
                           const DiagnoseOptions& options) {
  return {diagnosis,
          [&log, &model, &diagnosis, options] { return report_details(log, model, diagnosis, options); }};
}

}  // namespace faultline
