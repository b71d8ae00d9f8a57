// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/diagnose/curves/curves.hpp"
#include "lib/diagnose/diagnose_options.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"
#include "lib/report/fact_table.hpp"

namespace faultline {

/// What a page shows besides the diagnosis: the course of the run, and what the model knows of itself.
struct ReportDetails {
  RunCurves curves;
  std::vector<FactTable> model;       ///< identified parameters, how good the model is
  std::vector<FactTable> provenance;  ///< facts that a repetition of the diagnosis needs
};

/// The details of the diagnosis that diagnose() made of this log with this model and options. Reads the log a
/// second time, from its first row.
ReportDetails report_details(LogSource& log, const Model& model, const Diagnosis& diagnosis,
                             const DiagnoseOptions& options = {});

/// One self-contained page: nothing is loaded from elsewhere, and its Content-Security-Policy forbids it.
/// With `details` it has plots; they are pictures and tables without script and on paper. The same values
/// give the same bytes.
std::string render_html(const Diagnosis& diagnosis, const ReportDetails& details = {});

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

/// A format of reports that are written to files; each has a row in the table of html_report.cpp.
struct ReportFormat {
  const char* name;  ///< "json"; with "--" before it the option that asks for it
  const char* what;  ///< for a person who may ask for it: "Write " and this
  bool second_pass;  ///< shows details, so that the log is read a second time
  std::string (*render)(const ReportSource& source);
};
const std::vector<ReportFormat>& report_formats();

/// The format of this name, which must be one.
const ReportFormat& report_format(std::string_view name);

}  // namespace faultline
