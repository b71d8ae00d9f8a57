// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/inspection/inspection.hpp"
#include "lib/log/log.hpp"

namespace faultline {
namespace {

constexpr std::size_t kMostStretches = 1024;
constexpr std::size_t kMostChannels = 36;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

}  // namespace

void OverviewPass::begin(const Log& segment) {
  for_each_joint_channel(segment, [&](const std::vector<double>&, Channel channel) {
    overview_.channels.push_back({to_string(channel), true, {}, {}});
  });
  for (const ExtraChannel& extra : segment.extra) {
    if (overview_.channels.size() < kMostChannels)
      overview_.channels.push_back({extra.name, false, {}, {}});
    else
      ++overview_.channels_left_out;
  }
}

void OverviewPass::add_values(OverviewChannel& channel, const std::vector<double>& values) const {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto at = static_cast<std::size_t>((rows_ + static_cast<std::int64_t>(i)) / rows_a_stretch_);
    if (at == channel.low.size()) channel.low.push_back(kNone), channel.high.push_back(kNone);
    const auto value = static_cast<float>(values[i]);
    if (!std::isfinite(value)) continue;
    if (!(channel.low[at] <= value)) channel.low[at] = value;
    if (!(channel.high[at] >= value)) channel.high[at] = value;
  }
}

void OverviewPass::halve() {
  rows_a_stretch_ *= 2;
  const std::size_t left = overview_.from_s.size() / 2;
  for (std::size_t i = 0; i < left; ++i) {
    overview_.from_s[i] = overview_.from_s[2 * i];
    overview_.to_s[i] = overview_.to_s[2 * i + 1];
    for (OverviewChannel& channel : overview_.channels) {
      channel.low[i] = std::fmin(channel.low[2 * i], channel.low[2 * i + 1]);
      channel.high[i] = std::fmax(channel.high[2 * i], channel.high[2 * i + 1]);
    }
  }
  overview_.from_s.resize(left), overview_.to_s.resize(left);
  for (OverviewChannel& channel : overview_.channels) channel.low.resize(left), channel.high.resize(left);
}

void OverviewPass::add(const Log& segment) {
  if (rows_ == 0) begin(segment);
  for (int done = 0; done < segment.rows();) {
    if (rows_ == rows_a_stretch_ * static_cast<std::int64_t>(kMostStretches)) halve();
    const auto room = rows_a_stretch_ * static_cast<std::int64_t>(kMostStretches) - rows_;
    const int end = static_cast<int>(std::min<std::int64_t>(segment.rows(), done + room));
    const Log part = slice(segment, done, end);
    for (int i = 0; i < part.rows(); ++i) {
      const auto at = static_cast<std::size_t>((rows_ + i) / rows_a_stretch_);
      if (at == overview_.from_s.size())
        overview_.from_s.push_back(part.time[i]), overview_.to_s.push_back(0.0);
      overview_.to_s[at] = part.time[i];
    }
    std::size_t channel = 0;
    for_each_joint_channel(part, [&](const std::vector<double>& values, Channel) {
      add_values(overview_.channels[channel++], values);
    });
    for (const ExtraChannel& extra : part.extra)
      if (channel < overview_.channels.size()) add_values(overview_.channels[channel++], extra.values);
    rows_ += part.rows();
    done = end;
  }
}

}  // namespace faultline
