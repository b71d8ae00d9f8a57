// SPDX-License-Identifier: MIT
#include "lib/log/quality.hpp"

#include <cmath>

#include "lib/log/channel_names.hpp"
#include "lib/log/issues/quality_issues.hpp"
#include "lib/log/log_channels.hpp"

namespace faultline {
namespace {

template <typename Visit>
void visit_channels(const Log& log, Visit visit) {
  for_each_joint_channel(log, [&](const std::vector<double>& values, Channel channel) {
    visit(to_string(channel), std::string(), true, values);
  });
  for (const ExtraChannel& extra : log.extra) visit(extra.name, extra.unit, false, extra.values);
}

void add_value(ChannelSummary& channel, double value) {
  ++channel.values;
  if (value < channel.min) channel.min = value, channel.at_min = 0;
  if (value > channel.max) channel.max = value, channel.at_max = 0;
  channel.at_min += value == channel.min;
  channel.at_max += value == channel.max;
  if (!std::isnan(channel.last)) channel.path += std::abs(value - channel.last);
  channel.last = value;
}

void add_values(ChannelSummary& channel, const std::vector<double>& values, const Log& segment) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i])) {
      add_value(channel, values[i]);
    } else if (channel.missing++ == 0) {
      channel.first_missing_row = segment.first_row + static_cast<std::int64_t>(i) + 1;
      channel.first_missing_s = segment.time[i];
    }
  }
}

}  // namespace

void assess(const Log& segment, QualityState& state) {
  state.time.add(segment.time);
  std::size_t at = 0;
  visit_channels(segment,
                 [&](const std::string& name, const std::string& unit, bool canonical, const auto& values) {
                   if (at == state.channels.size())
                     state.channels.push_back({.name = name, .unit = unit, .canonical = canonical});
                   add_values(state.channels[at++], values, segment);
                 });
  state.velocity.resize(segment.dq.size());
  for (std::size_t j = 0; j < segment.dq.size(); ++j)
    state.velocity[j].add(segment.time, segment.q[j], segment.dq[j]);
}

LogQuality quality_of(const QualityState& state, const QualityOptions& options) {
  LogQuality quality;
  quality.time = without_run_breaks(state.time.result(), options.runs);
  quality.channels = state.channels;
  judge_time(quality.time, quality.issues);
  for (const ChannelSummary& channel : state.channels)
    judge_channel(channel, quality.time, options, quality.issues);
  for (std::size_t j = 0; j < state.velocity.size(); ++j) {
    quality.velocity.push_back(state.velocity[j].result());
  }
  judge_velocities(quality.velocity, quality.time, options, quality.issues);
  judge_motion_scale(quality.velocity, quality.issues);
  return quality;
}

}  // namespace faultline
