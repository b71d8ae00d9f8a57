// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/balance/uniform_log.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/diagnose/stop/stop_channels.hpp"

namespace faultline {

/// Returns the smallest changes that would have been seen if they had lasted for the last moment before a
/// stop: a torque of any cause on each joint, if the torque balance was judged, then each fault that the
/// model knows. `uniform` are the rows up to the stop, empty if they could not be judged.
std::vector<SeenChange> seen_changes(const StopRows& rows, const std::optional<UniformLog>& uniform,
                                     const Model& model, const Diagnosis& diagnosis);

/// Returns what a log of a few seconds can show; empty for a longer one.
std::optional<ShortLog> short_log(const Diagnosis& diagnosis, const StopRows& rows);

}  // namespace faultline
