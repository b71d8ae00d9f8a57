// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/weak_form/weak_form.hpp"

namespace faultline {

/// Returns the ripples that stand out of the residual of joint `j` in the shortest windows, strongest
/// first, at most three: peaks of the periodogram by position, with position and speed of each window taken
/// into account. Excludes ripples with less than three periods over the range and, of a revolute joint, with
/// a rate below 2.5 1/rad (2.5 periods a turn).
std::vector<Ripple> find_ripples(const WeakSets& windows, const WeakChoice& choice,
                                 const Eigen::VectorXd& parameters, int j);

}  // namespace faultline
