// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// A row of labels.csv: the known fault of a log.
struct LogLabel {
  std::string file;  ///< as written; compared by name without folders
  FaultLabel label;
  double onset_s = 0.0;
};

/// Reads `file,fault,joint,onset_s[,...]`; other columns are ignored. Throws Error(input) naming file, row
/// and column.
std::vector<LogLabel> read_labels(const std::string& path);

/// True when a file is such a table, by its first line; false if it cannot be read.
bool is_label_table(const std::string& path);

/// Returns the label of a log, by file name; null when there is none.
const LogLabel* label_of(const std::vector<LogLabel>& labels, const std::string& log);

}  // namespace faultline
