// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace faultline {

enum class Severity { note, warning, severe };

const char* to_string(Severity severity);

/// One kind of imperfection of an input that was processed all the same. Occurrences of the same (code,
/// channel) are counted in one Issue, so that a damaged log of a day does not produce a million of them.
struct Issue {
  std::string code;     ///< stable identifier, such as "time_backward"
  std::string channel;  ///< canonical channel name, empty if it concerns whole rows
  Severity severity = Severity::warning;
  std::string message;         ///< of the first occurrence: what, where, how it was handled
  std::int64_t first_row = 0;  ///< data row in the file, from 1; 0 if it has none
  double first_time_s = std::numeric_limits<double>::quiet_NaN();
  std::int64_t count = 0;         ///< occurrences
  std::int64_t rows_dropped = 0;  ///< rows left out because of it
};

/// Issues in the order of their first occurrence.
class Issues {
 public:
  /// Counts one more occurrence, or `issue.count` of them if that is positive.
  void add(Issue issue);
  void merge(const Issues& other);

  const std::vector<Issue>& all() const { return issues_; }
  bool empty() const { return issues_.empty(); }
  /// Returns null if no such issue was added.
  const Issue* find(const std::string& code, const std::string& channel = "") const;
  std::int64_t rows_dropped() const;

 private:
  std::vector<Issue> issues_;
};

/// Returns an issue of a whole log or of one `channel`, without a row.
inline Issue make_issue(std::string code, Severity severity, std::string message, std::string channel = "") {
  Issue issue;
  issue.code = std::move(code);
  issue.channel = std::move(channel);
  issue.severity = severity;
  issue.message = std::move(message);
  return issue;
}

/// Returns the issue with its texts unchanged; those from a file may be invalid UTF-8.
nlohmann::ordered_json issue_json(const Issue& issue);

}  // namespace faultline
