// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"

namespace faultline {

/// Logs (from 0) that a fit to the others leaves far more unexplained than it leaves the others: another
/// robot, another load, or a fault. Never half of them or more; none where folds are not logs.
std::vector<int> odd_logs(const ModelChoice& choice);

/// Tells how far logs differ: the standard deviation between fits to single logs, by parameter.
void tell_spread(const ModelChoice& choice, Identification& id);

/// Logs, from 0, that are another by its bytes; they are marked as left out and named in `id.issues`.
std::vector<int> repeated_logs(Identification& id);

}  // namespace faultline
