// SPDX-License-Identifier: MIT
#pragma once

#include "lib/log/quality.hpp"

namespace faultline {

/// Adds the faults of velocities compared with their positions to `issues`.
void judge_velocities(const std::vector<VelocityAgreement>& agreements, const TimeAxis& time,
                      const QualityOptions& options, Issues& issues);
/// Adds an issue if one factor other than 1 relates the positions and velocities of most moving joints.
void judge_motion_scale(const std::vector<VelocityAgreement>& agreements, Issues& issues);

}  // namespace faultline
