// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/fault/fault_kind.hpp"

/// The answer to the question what happened before a stop of the machine. Key `stop` of the diagnosis.
namespace faultline {

/// The moment that a diagnosis is asked about.
struct StopQuestion {
  double time_s = std::numeric_limits<double>::quiet_NaN();  ///< in the time of the log
  std::string column{};  ///< column whose first change is the moment; empty if the moment was given
};

/// A fault that began before the stop.
struct StopFinding {
  FaultLabel label;
  int fault_id = 0;  ///< the same fault among those of the whole log; 0 if it is not among them
  double onset_s = 0.0;
  double confidence = 0.0;      ///< 0 to 1
  double before_s = 0.0;        ///< from the onset to the stop
  double ended_before_s = 0.0;  ///< from the end to the stop; 0 if it was present at the stop
  bool by_rows_before = true;   ///< the rows up to the stop show it; false: only later rows raise its alarm
};

/// The signals that are compared just before a stop.
enum class StopSignal {
  torque_balance,     ///< torque against what the healthy robot needs for the motion
  motion_velocity,    ///< velocity against the regenerated fault-free motion
  motion_position,    ///< position against it
  actuator,           ///< measured against commanded torque
  control_law,        ///< commanded torque against reference and motion
  tracking_position,  ///< position against its reference
  tracking_velocity,  ///< velocity against its reference
  torque,             ///< largest torque
  speed,              ///< largest speed
  range,              ///< position outside of the range of the healthy logs
};
inline constexpr std::array kStopSignals{StopSignal::torque_balance,
                                         StopSignal::motion_velocity,
                                         StopSignal::motion_position,
                                         StopSignal::actuator,
                                         StopSignal::control_law,
                                         StopSignal::tracking_position,
                                         StopSignal::tracking_velocity,
                                         StopSignal::torque,
                                         StopSignal::speed,
                                         StopSignal::range};
const char* to_string(StopSignal signal);
/// Returns the name in words, such as "torque against the healthy robot".
const char* words_of(StopSignal signal);

enum class SignalState {
  normal,      ///< within its healthy range in the last moment
  changed,     ///< outside of it
  as_before,   ///< outside of it, but no further than before in the log
  no_range,    ///< the model has no healthy range: compared with the rest of the log alone
  not_looked,  ///< not recorded, or not judged
};
const char* to_string(SignalState state);

/// A signal of one joint in the last moment before a stop.
struct StopChannel {
  StopSignal signal = StopSignal::torque_balance;
  Joint joint{};
  SignalState state = SignalState::not_looked;
  double value = std::numeric_limits<double>::quiet_NaN();    ///< in the last moment, in `unit`
  double before = std::numeric_limits<double>::quiet_NaN();   ///< largest in the moments before it
  double limit = std::numeric_limits<double>::quiet_NaN();    ///< end of the healthy range
  std::string unit{};                                         ///< "healthy" for times the healthy spread
  double since_s = std::numeric_limits<double>::quiet_NaN();  ///< from when on it was outside, if it was
};

/// The earliest time from which on a signal was outside of its healthy range and stayed so, or returned to
/// it, up to the stop; or the onset of a finding that lasted up to the stop.
struct FirstSign {
  double time_s = std::numeric_limits<double>::quiet_NaN();
  double before_s = 0.0;  ///< from then to the stop
  Joint joint{};
  FaultKind kind = FaultKind::none;  ///< of the finding whose onset it is; none: of a signal
  StopSignal signal = StopSignal::torque_balance;
};

/// The joint whose torque or motion deviates most just before a stop.
struct LeadingJoint {
  Joint joint{};
  double times_healthy = std::numeric_limits<double>::quiet_NaN();
};

/// A change that lasts for the last moment, and whether it would have been seen.
struct SeenChange {
  FaultLabel label{};  ///< kind none: a torque of any cause on the joint
  bool could_be_found = false;
  double size = std::numeric_limits<double>::quiet_NaN();  ///< smallest; NaN for kinds without a size
  std::string unit{};
  bool by_this_log = false;  ///< from motion and noise of this log; else from the simulated logs of the model
  std::string why_not{};     ///< a clause
};

/// What a log of a few seconds can show.
struct ShortLog {
  double before_s = 0.0, after_s = 0.0;  ///< rows before and after the stop
  std::vector<std::string> notes{};      ///< sentences
};

struct StopAnswer {
  StopQuestion question;
  double looked_from_s = 0.0;                ///< begin of the rows that were compared; they end with the stop
  double moment_s = 0.0;                     ///< length of the last moment before the stop
  std::vector<StopFinding> findings{};       ///< present at the stop, then by the time from their end to it
  std::optional<FirstSign> first_sign{};     ///< none: nothing changed before the stop
  LeadingJoint leading{}, runner_up{};       ///< no joint if none could be compared
  std::vector<StopChannel> channels{};       ///< by joint, then by signal
  std::vector<SeenChange> seen{};            ///< smallest changes that would have been seen, lasting a moment
  std::vector<std::string> summary{};        ///< the answer in sentences
  std::vector<std::string> not_looked_at{};  ///< sentences
  std::optional<ShortLog> short_log{};       ///< only for a log of a few seconds
};

}  // namespace faultline
