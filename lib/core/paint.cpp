// SPDX-License-Identifier: MIT
#include "lib/core/paint.hpp"

#include <fmt/format.h>

namespace faultline {
namespace {

const char* code_of(Paint paint) {
  switch (paint) {
    case Paint::bold:
      return "1";
    case Paint::dim:
      return "2";
    case Paint::red:
      return "31";
    case Paint::yellow:
      return "33";
    case Paint::green:
      return "32";
    case Paint::bold_red:
      return "1;31";
    case Paint::bold_green:
      return "1;32";
  }
  return "0";
}

}  // namespace

std::string painted(std::string_view text, Paint paint, bool color) {
  return color ? fmt::format("\x1b[{}m{}\x1b[0m", code_of(paint), text) : std::string(text);
}

}  // namespace faultline
