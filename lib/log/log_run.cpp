// SPDX-License-Identifier: MIT
#include "lib/log/log_run.hpp"

#include <nlohmann/json.hpp>

#include "lib/core/json_values.hpp"

namespace faultline {

nlohmann::ordered_json log_run_json(const LogRun& run) {
  return {{"run", run.run},
          {"first_row", run.first_row},
          {"rows", run.rows},
          {"start_s", number_or_null(run.start_s)},
          {"end_s", number_or_null(run.end_s)},
          {"clock_offset_s", number_or_null(run.clock_offset_s)},
          {"read", run.is_read}};
}

}  // namespace faultline
