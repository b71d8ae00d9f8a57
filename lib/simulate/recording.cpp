// SPDX-License-Identifier: MIT
#include "lib/simulate/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/log/log.hpp"
#include "lib/simulate/joint_list.hpp"

namespace faultline {
namespace {

constexpr double kLeastGap = 0.01;  // least time between two stamps, as a share of the sample period

void differ_velocity(Log& log, double period_s) {
  for (int j = 0; j < log.joints(); ++j)
    for (int k = 1; k < log.rows(); ++k) log.dq[j][k] = (log.q[j][k] - log.q[j][k - 1]) / period_s;
}

/// Passes the velocity through a low pass of first order that holds its input between rows.
void filter_velocity(Log& log, double time_constant_s, double period_s) {
  const double share = 1.0 - elementary::exp(-period_s / time_constant_s);
  for (std::vector<double>& dq : log.dq) {
    double filtered = dq.empty() ? 0.0 : dq[0];
    for (double& v : dq) v = filtered += share * (v - filtered);
  }
}

void delay_torque(Log& log, int rows) {
  for (std::vector<double>& tau : log.tau)
    for (int k = log.rows() - 1; k > 0; --k) tau[k] = tau[std::max(k - rows, 0)];
}

void round_torque(Log& log, const std::vector<double>& resolution) {
  for (std::size_t j = 0; j < resolution.size(); ++j)
    for (double& tau : log.tau[j])
      if (resolution[j] > 0.0) tau = resolution[j] * std::round(tau / resolution[j]);
}

/// Sets the time stamps; a stamp that is not after the one before moves to the next possible time.
void stamp(Log& log, const RecordingSpec& spec, double period_s, Random& random) {
  const Clock clock(spec.stamp_resolution_s);
  std::int64_t last_tick = -1;
  double last = -kLeastGap * period_s;
  for (double& time : log.time) {
    if (spec.jitter_s > 0.0)
      time = std::max(time + spec.jitter_s * random.normal(), last + kLeastGap * period_s);
    last = time;
    if (!(spec.stamp_resolution_s > 0.0)) continue;
    last_tick = std::max<std::int64_t>(std::llround(time / spec.stamp_resolution_s), last_tick + 1);
    time = clock.at(last_tick);
  }
}

/// Returns the log without a random share `lost` of its inner rows.
Log thinned(const Log& log, double lost, Random& random) {
  std::vector<std::size_t> kept;
  for (int k = 0; k < log.rows(); ++k) {
    const bool inner = k > 0 && k + 1 < log.rows();
    if (!inner || random.uniform() >= lost) kept.push_back(static_cast<std::size_t>(k));
  }
  Log out;
  for_each_column(out, log, [&](std::vector<double>& mine, const std::vector<double>& all) {
    mine.reserve(kept.size());
    for (const std::size_t k : kept) mine.push_back(all[k]);
  });
  return out;
}

}  // namespace

void check_recording(int joints, double sample_period_s, const RecordingSpec& spec) {
  if (!(spec.jitter_s >= 0.0 && std::isfinite(spec.jitter_s)))
    bad_value("recording.jitter_s",
              fmt::format("expected a time that is not negative, found {}", spec.jitter_s));
  if (!(spec.stamp_resolution_s >= 0.0 && spec.stamp_resolution_s <= sample_period_s))
    bad_value("recording.stamp_resolution_s", fmt::format("expected 0 to the sample period of {} s, found {}",
                                                          sample_period_s, spec.stamp_resolution_s));
  if (!(spec.lost >= 0.0 && spec.lost < 1.0))
    bad_value("recording.lost",
              fmt::format("expected a share of the rows, 0 to below 1, found {}", spec.lost));
  if (!(spec.velocity_filter_s >= 0.0 && std::isfinite(spec.velocity_filter_s)))
    bad_value("recording.velocity_filter_s",
              fmt::format("expected a time that is not negative, found {}", spec.velocity_filter_s));
  if (spec.torque_late_rows < 0)
    bad_value("recording.torque_late_rows",
              fmt::format("expected rows, 0 or more, found {}", spec.torque_late_rows));
  check_not_negative(joints, spec.torque_resolution, "recording.torque_resolution");
}

Log recorded(Log exact, const RecordingSpec& spec, double sample_period_s, Random random) {
  if (spec.velocity == RecordedVelocity::difference) differ_velocity(exact, sample_period_s);
  if (spec.velocity_filter_s > 0.0) filter_velocity(exact, spec.velocity_filter_s, sample_period_s);
  if (spec.torque_late_rows > 0) delay_torque(exact, spec.torque_late_rows);
  round_torque(exact, spec.torque_resolution);
  Random losses(random.bits());  // independent of how many numbers the stamps draw
  stamp(exact, spec, sample_period_s, random);
  return spec.lost > 0.0 ? thinned(exact, spec.lost, losses) : exact;
}

}  // namespace faultline
