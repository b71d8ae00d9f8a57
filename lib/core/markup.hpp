// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace faultline {

/// Returns text that is safe inside XML 1.0 and HTML, also in quoted attributes: valid UTF-8, the five marks
/// escaped, control characters that XML cannot contain replaced by "?".
std::string escaped_markup(std::string_view text);

}  // namespace faultline
