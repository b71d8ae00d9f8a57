// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/identification.hpp"

namespace faultline {

/// Tests for a negative inertia, which no real robot has: if the inertia matrix has a negative eigenvalue
/// within the range of the logs, or clearly has one at other angles of the joints, the status becomes
/// `unexplained` and the reason names the value. Needs `joint_fits`, `estimate` and `covariance`.
void find_negative_inertia(Identification& id);

}  // namespace faultline
