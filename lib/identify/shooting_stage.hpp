// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/identify/gathered.hpp"
#include "lib/identify/identify.hpp"
#include "lib/identify/shooting/shooting.hpp"
#include "lib/identify/torque_fit.hpp"

namespace faultline {

/// Output error by shooting, and why it does not stand when it does not.
struct ShootingOutcome {
  ShootingFit fit;
  std::string refused;  ///< empty: the fit stands
};

/// Shoots from the torque fit, first over a few excerpts: where these already show a regular error that no
/// parameters remove, the rest is spared. The outcome stands when it converged, is a robot that can be, and
/// explains the torque about as well as the torque fit itself.
ShootingOutcome shoot(std::span<LogSource* const> logs, const Gathered& gathered, const TorqueFit& torque,
                      const Identification& id, const IdentifyOptions& options, const Progress& progress);

/// Whether some log is fast enough to show friction offset and width.
bool has_fast_log(const Identification& id);

}  // namespace faultline
