// SPDX-License-Identifier: MIT
#include "apps/report_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/options.hpp"
#include "lib/core/atomic_file.hpp"

namespace faultline {

std::vector<RequestedReport> all_reports() {
  std::vector<RequestedReport> reports;
  for (const ReportFormat& format : report_formats()) reports.push_back({&format});
  return reports;
}

void add_report_options(CLI::App& command, std::vector<RequestedReport>& reports) {
  for (RequestedReport& report : reports)
    add_file_option(command, std::string("--") + report.format->name, report.path,
                    std::string("Write ") + report.format->what);
}

bool standard_output_is_taken(const std::vector<RequestedReport>& reports) {
  return std::any_of(reports.begin(), reports.end(),
                     [](const RequestedReport& report) { return report.path == "-"; });
}

void write_reports(const std::vector<RequestedReport>& reports, const ReportSource& source) {
  for (const bool second_pass : {false, true})
    for (const RequestedReport& report : reports)
      if (!report.path.empty() && report.format->second_pass == second_pass)
        write_file(report.path, report.format->render(source));
}

}  // namespace faultline
