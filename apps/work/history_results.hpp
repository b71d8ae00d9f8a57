// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/history/history_record.hpp"

namespace faultline {

/// Returns the diagnoses at or below the given paths, sorted by path: files of diagnose --json; of a folder,
/// with all below it, the JSON files that are diagnoses; for index.ndjson or summary.json of a batch, its
/// folder. Hidden files, links and files of other kinds below a folder are passed over. Throws Error(input)
/// for a damaged diagnosis, for a given file that is none, and if there is none at all.
std::vector<HistoryRecord> history_results(const std::vector<std::string>& paths);

}  // namespace faultline
