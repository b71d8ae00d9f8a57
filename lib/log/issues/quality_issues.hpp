// SPDX-License-Identifier: MIT
#pragma once

#include "lib/log/quality.hpp"

namespace faultline {

/// Add to `issues` the faults of the time axis, of one channel, and of velocities compared with their
/// positions.
void judge_time(const TimeAxis& time, Issues& issues);
void judge_channel(const ChannelSummary& channel, const TimeAxis& time, const QualityOptions& options,
                   Issues& issues);
void judge_velocities(const std::vector<VelocityAgreement>& agreements, const TimeAxis& time,
                      const QualityOptions& options, Issues& issues);
/// Adds an issue if one factor other than 1 relates the positions and velocities of most moving joints.
void judge_motion_scale(const std::vector<VelocityAgreement>& agreements, Issues& issues);

}  // namespace faultline
