// SPDX-License-Identifier: MIT
#include "lib/core/markup.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr std::string_view kMarks = "&<>\"'\n\t";
constexpr std::array kEntities{"&amp;", "&lt;", "&gt;", "&quot;", "&apos;", "&#10;", "&#9;"};  // of kMarks

}  // namespace

std::string escaped_markup(std::string_view text) {
  const std::string valid = valid_utf8(text);
  std::string escaped;
  for (std::size_t i = 0; i < valid.size();) {
    const std::size_t command = command_length(valid, i);
    if (const std::size_t mark = kMarks.find(valid[i]); mark != std::string_view::npos)
      escaped += kEntities[mark];
    else
      escaped += command > 0 ? '?' : valid[i];
    i += std::max<std::size_t>(command, 1);
  }
  return escaped;
}

}  // namespace faultline
