// SPDX-License-Identifier: MIT
#include "lib/diagnose/question/clock_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr double kOtherClock = 1.3;  // times the period of the model's logs

double period_of(const Log& rows) { return (rows.time.back() - rows.time.front()) / (rows.rows() - 1); }

}  // namespace

double clock_ratio(const Log& rows, double sample_period_s) {
  if (rows.rows() < 2) return 1.0;
  const double ratio = period_of(rows) / sample_period_s;
  return ratio > kOtherClock || ratio < 1.0 / kOtherClock ? ratio : 1.0;
}

std::vector<ColumnReading> clock_readings(double ratio, double sample_period_s) {
  if (ratio == 1.0) return {};
  constexpr double kMilli = 1e-3, kNear = 0.05;  // s in a ms; relative error of a ratio that counts as ms
  const bool in_ms = std::abs(ratio * kMilli - 1.0) < kNear;
  ColumnReading reading;
  reading.what =
      in_ms ? "the time is in milliseconds"
            : fmt::format("its time runs {:.4g} times too {}: the motion is that of a row every {:.4g} s",
                          std::max(ratio, 1.0 / ratio), ratio > 1.0 ? "fast" : "slow", sample_period_s);
  reading.cure =
      in_ms ? "write unit = \"ms\" for t into [log.columns]"
            : fmt::format("write scale = {:.6g} for t into [log.columns], or mend the clock of the log",
                          1.0 / ratio);
  reading.apply = [ratio](Log& log) {
    for (double& t : log.time) t /= ratio;
  };
  return {reading};
}

std::vector<ColumnReading> delay_readings(const Log& rows) {
  // Rows: the first delay tried; the next is a third longer each time, up to a quarter of the log.
  constexpr int kFirstStep = 2, kFiner = 3, kShortest = 4;
  const double period = period_of(rows);
  std::vector<ColumnReading> out;
  for (int step = kFirstStep; kShortest * step < rows.rows(); step += std::max(1, step / kFiner))
    for (const int shift : {step, -step}) {
      out.push_back({fmt::format("the torques are logged about {:.2g} s too {}", std::abs(shift) * period,
                                 shift > 0 ? "late" : "early"),
                     "record torque and motion by one clock, or shift the torque before it is diagnosed",
                     [shift](Log& log) {
                       for (std::vector<double>& tau : log.tau) {
                         const std::vector<double> logged = tau;
                         const int last = static_cast<int>(tau.size()) - 1;
                         for (int k = 0; k <= last; ++k) tau[k] = logged[std::clamp(k + shift, 0, last)];
                       }
                     }});
    }
  return out;
}

}  // namespace faultline
