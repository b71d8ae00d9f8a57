// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace faultline {

/// What the comment line of a text table begins with that says its provenance.
inline constexpr std::string_view kProvenanceComment = "# faultline provenance: ";

}  // namespace faultline
