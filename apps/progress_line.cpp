// SPDX-License-Identifier: MIT
#include "apps/progress_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "lib/core/text.hpp"

namespace faultline {

std::string to_text(const ProgressLine& line) {
  const double share = std::isfinite(line.share) ? std::clamp(line.share, 0.0, 1.0) : 0.0;
  return fmt::format("faultline: {:3d} % {}", static_cast<int>(100.0 * share),
                     shortened(line.step, kLongestName));
}

std::optional<ProgressLine> parsed_progress(const std::string& line) {
  static const std::regex form("faultline: +([0-9]{1,3}) % (.*)");
  std::smatch parts;
  if (!std::regex_match(line, parts, form)) return std::nullopt;
  return ProgressLine{parts[2], std::stoi(parts[1]) / 100.0};
}

}  // namespace faultline
