// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lib/log/log_source.hpp"

namespace faultline {

/// Returns the log without values that its recorder did not measure: positions, velocities or torques of all
/// joints become NaN if they stopped, or became zero, while the others went on (positions_stopped,
/// velocities_stopped, torques_stopped). They did if the positions and velocities of at least two joints
/// contradict each other while one of the groups keeps every digit, or if velocities change while all torques
/// keep every digit after having changed before. A robot at rest, or at constant speed, is no contradiction;
/// a single joint is not judged, as its sensor may be faulty.
std::unique_ptr<LogSource> without_stopped_columns(std::unique_ptr<LogSource> source);

}  // namespace faultline
