// SPDX-License-Identifier: MIT
#pragma once

#include <cctype>
#include <string>

#include "lib/core/error.hpp"

namespace faultline {

/// Throws Error(input) for a file that ends, without a line break, in a number: truncation may have cut off
/// digits unnoticed. Any other truncated file does not parse.
inline void refuse_open_number(const std::string& text, const std::string& path) {
  if (text.empty() || !(std::isdigit(static_cast<unsigned char>(text.back())) || text.back() == '.')) return;
  throw Error(ErrorCode::input, path,
              "ends in a number without a line break and may be truncated: restore it, or end its last line "
              "with a line break");
}

}  // namespace faultline
