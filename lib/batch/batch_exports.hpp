// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/batch/batch_row.hpp"

namespace faultline {

// A batch for programs that show the results of many tools.

/// JUnit XML for continuous-integration servers: a test case for each log. A fault is a failure, a log
/// without a verdict is skipped, and one that cannot be used or failed is an error.
std::string batch_junit(const std::vector<BatchRow>& rows);

/// Custom content of MultiQC (a table with one row for each log), as JSON for a file that ends with
/// _mqc.json.
std::string batch_multiqc(const std::vector<BatchRow>& rows);

/// Returns the rows of the finished batch in a folder, in their order. Throws Error(input).
std::vector<BatchRow> rows_of_batch(const std::string& folder);

}  // namespace faultline
