// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "lib/core/issue.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// What a copy of a damaged log says of its original, so that a gap in it is not taken for the robot's: one
/// line of JSON, schema "faultline/provenance/1", ASCII only (docs/formats-csv.md). Empty when neither rows
/// nor values were lost. `source` was read to its end; a file that was not hashed is read once more.
std::string provenance_of(const LogSource& source);

/// The issue that a log has because of its provenance, severe when its original was severely damaged, or the
/// text cannot be read any more.
Issue issue_from_provenance(std::string_view text);

}  // namespace faultline
