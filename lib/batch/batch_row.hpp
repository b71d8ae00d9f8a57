// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/diagnose/fault_event.hpp"
#include "lib/identify/identification.hpp"

namespace faultline {

/// One log in an index: what a list of runs shows of its diagnosis, or why there is none.
struct BatchRow {
  std::string log;           ///< BatchLog::name, as valid UTF-8
  std::string sha256;        ///< empty when the log could not be read
  std::string model;         ///< its name
  std::string model_sha256;  ///< distinguishes models of one name
  std::string result;   ///< "logs/<result>.json", without folder and extension; empty without a diagnosis
  std::string verdict;  ///< as in the diagnosis, "unusable", or "failed" for a defect of the program
  std::string reason;
  std::string doubt;  ///< about the model, with which no log can be called healthy; empty without one
  std::string format;
  std::int64_t rows = 0, rows_used = 0;
  double start_s = std::numeric_limits<double>::quiet_NaN();
  double end_s = std::numeric_limits<double>::quiet_NaN();
  double sample_period_s = std::numeric_limits<double>::quiet_NaN();
  int joints = 0;
  int warnings = 0, severe = 0;  ///< kinds of issues of the log
  /// EvidenceScore::ratio() of the diagnosis; NaN if it is not known.
  double score = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> residual_rms;        ///< velocity, by joint, 1 = healthy (JointResidual)
  std::vector<double> residual_peak;       ///< likewise
  std::vector<FaultEvent> faults;          ///< by onset
  std::vector<ParameterValue> condition;   ///< of ConditionItem, those that the log determines
  std::vector<ParameterValue> parameters;  ///< identified from this log alone, when asked for and healthy
};

BatchRow row_of(const Diagnosis& diagnosis);
/// Of a log that could not be diagnosed. `path` is where it was read: it is not in the row.
BatchRow unusable_row(const std::string& name, const std::string& path, const Error& error,
                      const ModelFacts& model = {});
/// The largest residual of all joints; NaN without any.
double residual_level(const BatchRow& row);
/// The folder part of the log's name; empty without one.
std::string folder_of(const BatchRow& row);
/// 0 healthy, 1 a fault or no verdict, 3 unusable, 4 failed: the exit status that the log alone would give.
int status_of(const BatchRow& row);

/// One line of index.ndjson, with its end.
std::string to_json_line(const BatchRow& row);
BatchRow row_from_json(const std::string& text);
std::string batch_csv_header();
std::string to_csv_line(const BatchRow& row);

}  // namespace faultline
