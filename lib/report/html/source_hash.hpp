// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace faultline {

/// As Content-Security-Policy names an inline script or style: "'sha256-...'".
std::string source_hash(std::string_view content);

}  // namespace faultline
