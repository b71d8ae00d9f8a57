// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/log/log_source.hpp"

/// What a log shows, as text that tests compare.
namespace faultline {

inline std::string text_of(const Issues& issues) {
  std::string text;
  for (const Issue& issue : issues.all())
    text += issue.code + " " + issue.channel + " " + to_string(issue.severity) + " " + issue.message + " " +
            std::to_string(issue.first_row) + " " + std::to_string(issue.count) + " " +
            std::to_string(issue.rows_dropped) + "\n";
  return text;
}

inline std::string text_of(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += std::to_string(value) + " ";
  return text + "\n";
}

inline std::string text_of(const Log& log) {
  std::string text = std::to_string(log.first_row) + "\n" + text_of(log.time);
  for (const JointSignals* signals :
       {&log.q, &log.dq, &log.tau, &log.q_ref, &log.dq_ref, &log.tau_ref, &log.tau_meas})
    for (const auto& values : *signals) text += text_of(values);
  for (const ExtraChannel& extra : log.extra) text += extra.name + " " + text_of(extra.values);
  return text;
}

inline std::string standing_of(const LogSource& source) {
  const LogIdentity& identity = source.identity();
  return identity.path + " " + identity.format + " " + identity.sha256 + " " +
         std::to_string(identity.rows_read) + " " + std::to_string(source.share_read()) + "\n" +
         text_of(source.issues());
}

/// All that a log shows who reads it: what is known at first, then each segment and what is known after it.
inline std::string seen(LogSource& source, int segments = 1000) {
  std::string text = standing_of(source);
  Log segment;
  for (int i = 0; i < segments && source.next(segment); ++i) text += text_of(segment) + standing_of(source);
  return text + standing_of(source);
}

}  // namespace faultline
