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

/// Output error by shooting, and the reason if its fit is refused.
struct ShootingOutcome {
  ShootingFit fit;
  std::string refused;  ///< empty: the fit is accepted
};

/// Shoots from the torque fit, first over a few excerpts: if these already show a systematic error that no
/// parameters remove, the rest is skipped. The fit is accepted if it converged, is feasible and explains the
/// torque about as well as the torque fit.
ShootingOutcome shoot(std::span<LogSource* const> logs, const Gathered& gathered, const TorqueFit& torque,
                      const Identification& id, const IdentifyOptions& options, const Progress& progress);

}  // namespace faultline
