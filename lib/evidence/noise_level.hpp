// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "lib/evidence/log_noise.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// How much q and dq of one log jitter from row to row where the robot is calmest, by joint; 0 where nothing
/// can be said. It holds the measurement noise and, where rows are far apart, some motion: compare it with
/// that of other logs of the same robot.
struct NoiseLevel {
  std::vector<double> q, dq;
};

NoiseLevel noise_level(const Log& log);

/// The root mean square of the levels, joint by joint, of those that could be told.
NoiseLevel usual_level(const std::vector<NoiseLevel>& levels);

/// How a log of that level measures against the usual one, within `bounds`; 1 where either is not known.
LogNoise noise_against(const NoiseLevel& usual, const NoiseLevel& level, const std::array<double, 2>& bounds);

}  // namespace faultline
