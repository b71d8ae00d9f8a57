// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "lib/log/log_source.hpp"

namespace faultline {

/// A log whose torques act later (or earlier) than they are logged, told as if they acted when logged: the
/// torque of joint j at time t is that of the log at t - delay_s[j], on a straight line between its samples.
/// Before the first and after the last logged torque it is that one. Torques are multiplied by `gain`, where
/// given. All else passes as it is.
class DelayedTorqueSource : public LogSource {
 public:
  /// `source` stands at its first row and is read by nobody else; it outlives this.
  DelayedTorqueSource(LogSource& source, std::vector<double> delay_s, std::vector<double> gain = {});
  /// The same, keeping the source.
  DelayedTorqueSource(std::unique_ptr<LogSource> source, std::vector<double> delay_s,
                      std::vector<double> gain = {});

  bool next(Log& segment) override;
  void rewind() override;
  const LogIdentity& identity() const override { return source_.identity(); }
  const Issues& issues() const override { return source_.issues(); }
  double share_read() const override { return source_.share_read(); }

 private:
  bool fill();
  double torque_at(int joint, double t);

  std::unique_ptr<LogSource> owned_;
  LogSource& source_;
  std::vector<double> delay_s_, gain_;  ///< by joint; joints beyond act when logged, and as logged
  double ahead_s_ = 0.0;                ///< how much later torque is needed than the row it is for
  double behind_s_ = 0.0;               ///< how much earlier
  Log rows_;                            ///< rows not handed out yet
  bool at_end_ = false;
  std::vector<double> time_;  ///< of the torques kept
  JointSignals tau_;
  std::vector<std::size_t> position_;  ///< by joint: first kept torque not before what was asked last
};

}  // namespace faultline
