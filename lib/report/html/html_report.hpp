// SPDX-License-Identifier: MIT
#pragma once

#include <string>
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

}  // namespace faultline
