// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/inspection/analyses.hpp"
#include "apps/inspection/overview.hpp"
#include "formats/open_log.hpp"
#include "lib/core/progress.hpp"
#include "lib/log/column_matching.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/quality.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/plausibility/checkup/checkup.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// A channel as it was found, and the column it comes from (empty: none).
struct InspectedChannel {
  ChannelSummary summary;
  std::string column;
  std::string unit;
};

/// What a log holds, what is wrong with it, and what a diagnosis would miss.
struct Inspection {
  LogIdentity log;
  bool joint_log =
      false;  ///< false: no time or no position was found; `why_not` says which and how to name it
  std::string why_not;
  int joints = 0;
  std::int64_t rows_used = 0;
  LogQuality quality;
  CheckupResult checkup;
  LogOverview overview;  ///< for pictures
  std::vector<InspectedChannel> channels;
  std::vector<std::string> lacking;  ///< what a diagnosis would have to do without
  std::vector<PossibleAnalysis> analyses;
  Issues issues;  ///< of reading, cleaning, quality and the closer look together

  bool severe() const;
  /// Rows used of rows read, and of the rows that the span of time has at this sample period; 0 to 1, NaN
  /// while unknown.
  double share_used() const;
  double completeness() const;
};

/// "sound", "doubtful" (a warning), "damaged" (something severe) or "no_joint_log".
const char* verdict_of(const Inspection& inspection);
/// The verdict on the recording in a sentence, which leaves the robot to `faultline diagnose`.
std::string verdict_sentence_of(const Inspection& inspection);

/// Throws Error(input) when nothing can be read from the file.
Inspection inspect_log(const std::string& path, const std::optional<Robot>& robot, const Progress& progress,
                       const LogSelection& parts = {});

/// The same of columns that are open already; what they mean says the robot, `run` counts where the clock
/// restarts.
Inspection inspect_columns(std::unique_ptr<RawReader> reader, const std::optional<Robot>& robot,
                           const Progress& progress, int run = kEveryRun);

std::string inspection_text(const Inspection& inspection, bool color);
nlohmann::ordered_json inspection_json(const Inspection& inspection);
/// Of several logs, schema "faultline/inspection/1".
std::string inspections_json(const std::vector<Inspection>& inspections);

}  // namespace faultline
