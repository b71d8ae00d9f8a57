// SPDX-License-Identifier: MIT
#include "lib/core/issue_json.hpp"

#include <nlohmann/json.hpp>

#include "lib/core/json_values.hpp"

namespace faultline {

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
