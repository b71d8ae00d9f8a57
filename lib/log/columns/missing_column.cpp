// SPDX-License-Identifier: MIT
#include "lib/log/columns/missing_column.hpp"

#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr std::size_t kMostNamed = 20;

}  // namespace

std::string missing_column_sentence(const std::vector<std::string>& columns, const std::string& channel,
                                    const std::string& meaning) {
  std::string found;
  for (std::size_t i = 0; i < columns.size() && i < kMostNamed; ++i)
    found += (i ? ", \"" : "\"") + shortened(columns[i], kLongestName) + "\"";
  if (columns.size() > kMostNamed) found += " and " + std::to_string(columns.size() - kMostNamed) + " more";
  return "no column for the " + meaning + " (" + channel + ") was found; the columns are " + found +
         ". Name it in the robot file: [log.columns] " + channel + " = {name = \"...\"}" +
         (channel == "t" ? "; without any, t = {name = \"@row\", scale = SAMPLE_PERIOD_IN_S}" : "");
}

}  // namespace faultline
