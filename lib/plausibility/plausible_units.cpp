// SPDX-License-Identifier: MIT
#include "lib/plausibility/plausible_units.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>

#include "lib/core/error.hpp"
#include "lib/log/quality.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

constexpr std::int64_t kLookedAt = 50'000;  // first rows that are used: over a minute at 500 Hz, read fast

/// Returns the issues of the first rows; none for another number of joints, which is reported elsewhere.
Issues issues_of_beginning(LogSource& log, const QualityOptions& options) {
  QualityState state;
  std::int64_t rows = 0;
  bool fits = true;
  log.rewind();
  for (Log segment; fits && rows < kLookedAt && log.next(segment); rows += segment.rows()) {
    fits = static_cast<std::size_t>(segment.joints()) == options.slides.size();
    assess(segment, state);
  }
  log.rewind();
  if (!fits) return {};
  QualityOptions with_units = options;
  with_units.stated_units = log.identity().stated_units;
  return quality_of(state, with_units).issues;
}

}  // namespace

std::vector<std::string> implausible_units(std::span<LogSource* const> logs, const Robot& robot) {
  QualityOptions options;
  options.slides = sliding_joints(robot.chain);
  options.position_span = kHealthySpan_rad;
  std::vector<std::string> sentences;
  for (LogSource* log : logs) {
    const Issues issues = issues_of_beginning(*log, options);
    for (const Issue& issue : issues.all())
      if (issue.code == "unit_implausible" && issue.severity == Severity::severe)
        sentences.push_back(std::filesystem::path(log->identity().path).filename().string() + ": " +
                            issue.channel + " " + issue.message);
  }
  return sentences;
}

void refuse_implausible_units(std::span<LogSource* const> logs, const Robot& robot) {
  const std::vector<std::string> sentences = implausible_units(logs, robot);
  if (sentences.empty()) return;
  const std::string more =
      sentences.size() > 1 ? fmt::format(" ({} more channels look wrong)", sentences.size() - 1) : "";
  throw Error(ErrorCode::input, "the units of the logs",
              fmt::format("look wrong: {}{}. --force continues nevertheless", sentences.front(), more));
}

}  // namespace faultline
