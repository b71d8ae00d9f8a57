// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "lib/core/joint.hpp"

namespace faultline {

struct HistoryFinding {
  std::string kind;  ///< as in the diagnosis, such as "locked"
  Joint joint{};
  double onset_s = std::numeric_limits<double>::quiet_NaN();
  double confidence = std::numeric_limits<double>::quiet_NaN();
};

struct HistoryCondition {
  std::string name;  ///< such as "friction_1"
  double value = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 2> ci95 = {value, value};
  double normal_range = std::numeric_limits<double>::quiet_NaN();
  std::string unit;

  /// As ConditionItem::is_determined().
  bool is_determined() const { return 0.5 * (ci95[1] - ci95[0]) < normal_range; }
};

/// What a history keeps of one diagnosis.
struct HistoryRecord {
  std::string log_sha256, model_sha256;  ///< its key
  std::string robot;                     ///< name of the model
  std::string log;                       ///< path in the diagnosis
  std::string verdict;
  double start_s = std::numeric_limits<double>::quiet_NaN();
  double end_s = std::numeric_limits<double>::quiet_NaN();
  std::vector<HistoryFinding> findings;
  std::vector<HistoryCondition> condition;
};

/// Whether a text is a diagnosis as JSON, by its schema.
bool is_diagnosis_json(const std::string& text);

/// Reads a diagnosis, schema "faultline/diagnosis/1". Throws Error(input) with `where` for another or a
/// damaged one.
HistoryRecord history_record(const std::string& json, const std::string& where);

/// Returns the SHA-256 of all values of a record.
std::string digest_of(const HistoryRecord& record);

}  // namespace faultline
