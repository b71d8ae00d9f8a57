// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/report/html/html_report.hpp"

namespace faultline {

/// What a report is rendered from.
struct ReportSource {
  const Diagnosis& diagnosis;
  /// Reads the log once more; only formats with `second_pass` call it.
  std::function<ReportDetails()> details;
};

/// The source of the report on a diagnosis that diagnose() made of this log with this model and options. They
/// must outlive it.
ReportSource report_source(LogSource& log, const Model& model, const Diagnosis& diagnosis,
                           const DiagnoseOptions& options);

/// A format of reports that are written to files; each has a row in the table of report_formats.cpp.
struct ReportFormat {
  const char* name;       ///< "json"; with "--" before it the option that asks for it
  const char* extension;  ///< of files, ".json"
  const char* what;       ///< for a person who may ask for it: "Write " and this
  bool second_pass;       ///< shows details, so that the log is read a second time
  std::string (*render)(const ReportSource& source);
};
const std::vector<ReportFormat>& report_formats();

/// The format of this name, which must be one.
const ReportFormat& report_format(std::string_view name);

}  // namespace faultline
