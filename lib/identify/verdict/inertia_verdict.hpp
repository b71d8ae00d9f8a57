// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/identification.hpp"

namespace faultline {

/// A robot with a negative inertia, that would run towards what brakes it, is none: where the inertia matrix
/// has a negative value over the range of the logs, or surely has one where the joints could turn to, the
/// status becomes `unexplained` and the reason names the value. Needs `joint_fits`, `estimate` and
/// `covariance`.
void find_negative_inertia(Identification& id);

}  // namespace faultline
