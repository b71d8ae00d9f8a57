// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/batch/batch_summary.hpp"

namespace faultline {

/// Puts the finished shards of one batch together into `into`: the same bytes as one run over the whole list.
/// Throws Error(input) when a folder is no finished batch, was made with other model, cases, options or logs,
/// or a shard is missing.
BatchSummary merge_batches(const std::vector<std::string>& folders, const std::string& into);

}  // namespace faultline
