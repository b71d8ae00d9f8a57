// SPDX-License-Identifier: MIT
#include "lib/learn/torque_reading.hpp"

namespace faultline {

TorqueReading reading_of(const Robot& opened_with, const Robot& robot) {
  TorqueReading out{robot.torque_delay_s, robot.torque_gain};
  out.delay_s.resize(robot.joints(), 0.0);
  out.gain.resize(robot.joints(), 1.0);
  for (std::size_t j = 0; j < opened_with.torque_delay_s.size(); ++j)
    out.delay_s[j] -= opened_with.torque_delay_s[j];
  for (std::size_t j = 0; j < opened_with.torque_gain.size(); ++j) out.gain[j] /= opened_with.torque_gain[j];
  return out;
}

std::deque<DelayedTorqueSource> in_time(std::span<LogSource* const> logs, const TorqueReading& reading,
                                        const std::vector<IdentifiedLog>& identified) {
  std::deque<DelayedTorqueSource> out;
  for (std::size_t i = 0; i < logs.size(); ++i)
    if (!identified[i].left_out) out.push_back(reading.of(*logs[i]));
  return out;
}

std::vector<LogSource*> pointers(std::deque<DelayedTorqueSource>& logs) {
  std::vector<LogSource*> out;
  for (DelayedTorqueSource& log : logs) out.push_back(&log);
  return out;
}

}  // namespace faultline
