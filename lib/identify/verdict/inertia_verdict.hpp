// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lib/identify/identification.hpp"

namespace faultline {

/// Tests for a negative inertia, which no real robot has: if the inertia matrix has a negative eigenvalue
/// within the range of the logs, or clearly has one at other angles of the joints, returns `unexplained` with
/// a reason that names the value. Needs `joint_fits`, `estimate` and `covariance`.
std::optional<FitStatus> negative_inertia(const Identification& id);

}  // namespace faultline
