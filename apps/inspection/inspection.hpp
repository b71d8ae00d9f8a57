// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/open_log.hpp"
#include "lib/core/progress.hpp"
#include "lib/log/column_matching.hpp"
#include "lib/log/log.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/quality.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/log/velocity_check.hpp"
#include "lib/plausibility/checkup/checkup.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// One channel of an overview: least and largest value of each stretch of rows; NaN if it has none.
struct OverviewChannel {
  std::string name;
  bool canonical = true;
  std::vector<float> low, high;
};

/// A log of any length in at most 1024 stretches of equally many rows: enough for a picture.
struct LogOverview {
  std::vector<double> from_s, to_s;  ///< first and last time of each stretch, s
  std::vector<OverviewChannel> channels;
  std::size_t channels_left_out = 0;
};

/// Makes an overview from the segments of a log; the result does not depend on how it is divided.
class OverviewPass {
 public:
  void add(const Log& segment);
  const LogOverview& result() const { return overview_; }

 private:
  void begin(const Log& segment);
  void add_values(OverviewChannel& channel, const std::vector<double>& values) const;
  void halve();

  LogOverview overview_;
  std::int64_t rows_ = 0;
  std::int64_t rows_a_stretch_ = 1;
};

struct Inspection;

enum class AnalysisFit { impossible, limited, possible };

const char* to_string(AnalysisFit fit);

/// Whether an analysis of a log is possible, why not, and how to make it possible.
struct PossibleAnalysis {
  std::string name;  ///< "identify", "learn", "torque_residuals", "tracking", "motion"
  std::string what;  ///< description for the user
  AnalysisFit fit = AnalysisFit::impossible;
  std::vector<std::string> channels{};  ///< channels that the analysis uses
  std::string why{};                    ///< empty when possible without reservation
  std::string help{};                   ///< what would make more possible; may be empty
};

std::vector<PossibleAnalysis> possible_analyses(const Inspection& inspection);

/// A channel of the log, and the column that it comes from (empty: none).
struct InspectedChannel {
  ChannelSummary summary;
  std::string column;
  std::string unit;
};

/// The content of a log, its defects, and the channels that a diagnosis would miss.
struct Inspection {
  LogIdentity log;
  bool joint_log =
      false;  ///< false: no time or no position was found; `why_not` gives the reason and how to name it
  std::string why_not;
  int joints = 0;
  std::int64_t rows_used = 0;
  LogQuality quality;
  CheckupResult checkup;
  LogOverview overview;  ///< for pictures
  std::vector<InspectedChannel> channels;
  std::vector<std::string> lacking;  ///< channels missing for a diagnosis
  std::vector<PossibleAnalysis> analyses;
  Issues issues;  ///< of reading, cleaning, quality and checkup together

  bool severe() const;
  /// Rows used as a share of the rows read, and of the rows that the time span has at this sample period; 0
  /// to 1, NaN while unknown.
  double share_used() const;
  double completeness() const;
  /// Returns null for a channel that is not canonical.
  const ChannelCheckup* checkup_of(const std::string& channel, bool canonical) const;
};

/// Returns "sound", "doubtful" (a warning), "damaged" (a severe issue) or "no_joint_log".
const char* verdict_of(const Inspection& inspection);
/// Returns the verdict on the recording as a sentence; `faultline diagnose` judges the robot.
std::string verdict_sentence_of(const Inspection& inspection);
/// Returns "gap t, 3 times, first in row 17 at 0.4 s, 2 rows left out", the time only on request.
std::string issue_words(const Issue& issue, bool with_time);

/// Inspects a log. Throws Error(input) when nothing can be read from the file.
Inspection inspect_log(const std::string& path, const std::optional<Robot>& robot, const Progress& progress,
                       const LogSelection& parts = {});

/// Does the same for columns that are open already. The robot gives their meaning; `run` counts the restarts
/// of the clock.
Inspection inspect_columns(std::unique_ptr<RawReader> reader, const std::optional<Robot>& robot,
                           const Progress& progress, int run = kEveryRun);

std::string inspection_text(const Inspection& inspection, bool color);
nlohmann::ordered_json inspection_json(const Inspection& inspection);
/// Returns several logs as JSON, schema "faultline/inspection/1".
std::string inspections_json(const std::vector<Inspection>& inspections);

/// Returns one self-contained page without scripts: the verdicts, the issues, and pictures of all channels.
std::string inspection_page(const std::vector<Inspection>& inspections);

/// Returns pictures of the channels with gaps and stuck stretches shaded; empty without rows. `prefix` makes
/// the names inside them unique to this log.
std::string inspection_figures(const Inspection& inspection, const std::string& prefix);

/// Estimates the time between two rows of a log without a clock from the changes of position per row,
/// compared with the velocities.
class RowClock {
 public:
  /// Uses a table that `columns` map to a joint log except for the time; any other table gives no estimate.
  RowClock(const std::vector<RawColumn>& table, ColumnMap columns, const std::string& path);
  void add(const RawBlock& block);

  struct Estimate {
    double period_s = 0.0;
    double std_s = 0.0;
  };
  /// Returns nullopt unless the moving joints agree.
  std::optional<Estimate> estimate() const;

 private:
  std::vector<double> values_of(const RawBlock& block, Channel channel) const;

  Matching matching_;
  std::vector<VelocityCheck> joints_;
  std::vector<double> rows_;
};

}  // namespace faultline
