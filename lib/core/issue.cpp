// SPDX-License-Identifier: MIT
#include "lib/core/issue.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "lib/core/json_values.hpp"
#include "lib/core/text.hpp"

namespace faultline {

const char* to_string(Severity severity) {
  static constexpr std::array kNames{"note", "warning", "severe"};
  static_assert(kNames.size() == static_cast<std::size_t>(Severity::severe) + 1);
  return kNames[static_cast<std::size_t>(severity)];
}

void Issues::add(Issue issue) {
  issue.count = std::max<std::int64_t>(issue.count, 1);
  for (Issue& known : issues_) {
    if (known.channel == issue.channel && known.code == issue.code) {
      known.count += issue.count;
      known.rows_dropped += issue.rows_dropped;
      known.severity = std::max(known.severity, issue.severity);
      return;
    }
  }
  issue.message = brief(issue.message);
  issues_.push_back(std::move(issue));
}

void Issues::merge(const Issues& other) {
  for (const Issue& issue : other.issues_) add(issue);
}

const Issue* Issues::find(const std::string& code, const std::string& channel) const {
  for (const Issue& issue : issues_)
    if (issue.code == code && issue.channel == channel) return &issue;
  return nullptr;
}

std::int64_t Issues::rows_dropped() const {
  std::int64_t rows = 0;
  for (const Issue& issue : issues_) rows += issue.rows_dropped;
  return rows;
}

nlohmann::ordered_json issue_json(const Issue& issue) {
  return {{"code", issue.code},
          {"channel", text_or_null(issue.channel)},
          {"severity", to_string(issue.severity)},
          {"message", issue.message},
          {"first_row", count_or_null(issue.first_row)},
          {"first_time_s", number_or_null(issue.first_time_s)},
          {"count", issue.count},
          {"rows_dropped", issue.rows_dropped}};
}

}  // namespace faultline
