// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "formats/open_log.hpp"
#include "lib/diagnose/stop/stop_answer.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// Returns the moment of a text: seconds, or a date with a time such as "2026-11-24T08:15:30.2Z" (UTC without
/// a zone) as seconds since 1970, or a time of day as seconds since midnight. Throws Error(usage) for any
/// other text; `option` names it.
double moment_of(const std::string& text, const std::string& option);

/// A log in which a stop is looked for.
struct StopLog {
  std::string name;                                  ///< as in messages
  int run = 0;                                       ///< the run that is read, as LogSelection::run
  std::function<std::unique_ptr<RawReader>()> open;  ///< its columns, from the first row
};

/// Returns the log of a file and its parts; `choice` as for open_parts().
StopLog stop_log(const std::string& path, const LogSelection& parts, const RecordingChoice& choice);

/// Returns the time at which a column of the log first rises from 0 to another number (false to true), or
/// changes its text; empty if it never does. A text that appears behind missing cells counts, missing cells
/// do not. Reads the log up to there. Throws Error(usage) if the log has no such column, or uses it as a
/// channel.
std::optional<double> first_change_of(const StopLog& log, const Robot& robot, const std::string& column);

/// Returns the question about a stop: about the moment `moment` (moment_of()); else about the first change of
/// `column`; else about that of the column that the robot file names, if the log has it and it changes. Empty
/// if none is asked. Throws Error(usage) as above, and if `column` never changes.
std::optional<StopQuestion> stop_question(const StopLog& log, const Robot& robot, const std::string& moment,
                                          const std::string& column);

}  // namespace faultline
