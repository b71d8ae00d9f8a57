// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/report/html/report_formats.hpp"

namespace CLI {
class App;
}

namespace faultline {

/// A report that may be asked for.
struct RequestedReport {
  const ReportFormat* format;
  std::string path{};  ///< - for standard output; empty: not asked for
};

/// Every format of reports, none asked for.
std::vector<RequestedReport> all_reports();

/// Adds an option for each, such as --json F. `reports` must stay where it is until the command was parsed.
void add_report_options(CLI::App& command, std::vector<RequestedReport>& reports);

/// Whether a report goes to standard output.
bool standard_output_is_taken(const std::vector<RequestedReport>& reports);

/// Writes what was asked for; what needs a second pass over the log comes last.
void write_reports(const std::vector<RequestedReport>& reports, const ReportSource& source);

}  // namespace faultline
