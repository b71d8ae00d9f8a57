// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/weak_form/weak_system.hpp"

namespace faultline {

/// Ripples that stand out of what a fit leaves of joint `joint` in the shortest windows: the periodogram by
/// position, each window's position and speed taken into account, strongest first, at most three. Nothing is
/// said of what repeats less than three times over the range or, on a turning joint, less than 2.5 times a
/// rad.
std::vector<Ripple> find_ripples(const WeakSets& windows, const WeakChoice& choice,
                                 const Eigen::VectorXd& parameters, int joint);

}  // namespace faultline
