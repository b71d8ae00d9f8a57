// SPDX-License-Identifier: MIT
#include "lib/core/outgoing/inside_script.hpp"

namespace faultline {

std::string inside_script(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

}  // namespace faultline
