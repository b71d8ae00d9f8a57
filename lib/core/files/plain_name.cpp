// SPDX-License-Identifier: MIT
#include "lib/core/files/plain_name.hpp"

#include <algorithm>

#include "lib/core/text.hpp"

namespace faultline {
namespace {

bool is_control(unsigned char c) { return c < 0x20 || c == 0x7f; }

}  // namespace

bool is_plain_name(std::string_view name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string_view::npos &&
         std::none_of(name.begin(), name.end(), is_control);
}

bool is_plain_path(std::string_view path) {
  for (;;) {
    const std::size_t end = path.find('/');
    if (!is_plain_name(path.substr(0, end))) return false;
    if (end == std::string_view::npos) return true;
    path.remove_prefix(end + 1);
  }
}

bool is_plain_log_name(std::string_view name) { return is_plain_path(printable(name)); }

}  // namespace faultline
