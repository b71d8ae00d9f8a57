// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/identify/excerpt.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/weak_form/weak_form.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// What one pass over the logs gathers.
struct Gathered {
  WeakWindows windows;
  Excerpts excerpts;
  Roughness roughness;
};

/// Reads every log once; what is known of each goes to `id.logs`, what was wrong to `id.issues`. Throws
/// Error(input) when they give too few windows.
void gather(std::span<LogSource* const> logs, const Progress& progress, Gathered& gathered,
            Identification& id);

/// Least noise a channel can have: rounding of its digits. q (first) and dq by joint.
Eigen::VectorXd noise_floor(const Roughness& roughness);
/// Noise as roughness shows it; on logs too slow to tell, a share of the range.
Eigen::VectorXd first_noise(const Roughness& roughness);

/// Joints, from 1, whose position hardly changed against its noise in all logs.
std::vector<int> still_joints(const Roughness& roughness);

}  // namespace faultline
