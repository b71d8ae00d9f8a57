// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace faultline {

/// Beginning of the comment line of a text table that contains its provenance.
inline constexpr std::string_view kProvenanceComment = "# faultline provenance: ";

}  // namespace faultline
