// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "lib/core/issue.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// Beginning of the comment line of a text table that contains its provenance.
inline constexpr std::string_view kProvenanceComment = "# faultline provenance: ";

/// Returns the losses of a damaged log as text for its copy, so that a gap is not attributed to the robot:
/// one line of ASCII JSON, schema "faultline/provenance/1" (docs/formats-csv.md). Empty without lost rows or
/// values and severe issues. `source` was read to its end; one without a hash is read once more.
std::string provenance_of(const LogSource& source);

/// Returns the issue that a log has because of its provenance: severe when an issue of the original was
/// severe or the text is not valid.
Issue issue_from_provenance(std::string_view text);

}  // namespace faultline
