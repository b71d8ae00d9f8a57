// SPDX-License-Identifier: MIT
#include "lib/core/paint.hpp"

#include <fmt/format.h>

#include <array>

namespace faultline {
namespace {

/// In the order of Paint.
constexpr std::array kCodes{"1", "2", "31", "33", "32", "1;31", "1;32"};
static_assert(kCodes.size() == static_cast<std::size_t>(Paint::bold_green) + 1);

}  // namespace

std::string painted(std::string_view text, Paint paint, bool color) {
  return color ? fmt::format("\x1b[{}m{}\x1b[0m", kCodes[static_cast<std::size_t>(paint)], text)
               : std::string(text);
}

}  // namespace faultline
