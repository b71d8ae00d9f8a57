// SPDX-License-Identifier: MIT
#pragma once

#include "lib/log/quality.hpp"

namespace faultline {

/// Adds to `issues` what is wrong with the time axis, with one channel, or between a velocity and its
/// position.
void judge_time(const TimeAxis& time, const QualityOptions& options, Issues& issues);
void judge_channel(const ChannelSummary& channel, const QualityOptions& options, Issues& issues);
void judge_velocity(const VelocityAgreement& agreement, int joint, Issues& issues);

}  // namespace faultline
