// SPDX-License-Identifier: MIT
#include "lib/core/json/json_depth.hpp"

#include "lib/core/error.hpp"

namespace faultline {

void refuse_deep_json(std::string_view json, const std::string& where) {
  int open = 0;
  bool quoted = false;
  for (std::size_t at = 0; at < json.size(); ++at) {
    const char c = json[at];
    if (quoted && c == '\\') {
      ++at;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && (c == '[' || c == '{')) {
      if (++open > kMostJsonNesting)
        throw Error(ErrorCode::input, where,
                    "nests lists and objects more deeply than " + std::to_string(kMostJsonNesting) +
                        " levels, unlike any file of faultline; restore it or create it again");
    } else if (!quoted && (c == ']' || c == '}')) {
      --open;
    }
  }
}

}  // namespace faultline
