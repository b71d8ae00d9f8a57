// SPDX-License-Identifier: MIT
#pragma once

#include "lib/log/quality.hpp"

namespace faultline {

/// Adds to `issues` what is wrong with the time axis, with one channel, or between velocities and their
/// positions.
void judge_time(const TimeAxis& time, const QualityOptions& options, Issues& issues);
void judge_channel(const ChannelSummary& channel, const TimeAxis& time, const QualityOptions& options,
                   Issues& issues);
void judge_velocities(const std::vector<VelocityAgreement>& agreements, const TimeAxis& time,
                      const QualityOptions& options, Issues& issues);
/// Whether the positions of most joints change by one factor too fast or too slowly for their velocities.
void judge_motion_scale(const std::vector<VelocityAgreement>& agreements, Issues& issues);

}  // namespace faultline
