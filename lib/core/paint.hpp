// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace faultline {

enum class Paint { bold, dim, red, yellow, green, bold_red, bold_green };

/// Returns `text` between terminal colour codes if `color`, else unchanged.
std::string painted(std::string_view text, Paint paint, bool color);

}  // namespace faultline
