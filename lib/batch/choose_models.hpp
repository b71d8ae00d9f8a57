// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/batch/find_logs.hpp"

namespace faultline {

/// Returns the logs, each with the model whose folder it lies in (BatchLog::model = place in `folders`):
/// `folders` holds the folder of each model, "" for the model of all other logs. A log lies in a folder when
/// its file does, or when the parts of the folder's name follow each other in the log's name; of several the
/// deepest counts. Throws Error(usage) when a log has no model, a folder has two, or there is no folder of a
/// name.
std::vector<BatchLog> with_models(std::vector<BatchLog> logs, const std::vector<std::string>& folders);

}  // namespace faultline
