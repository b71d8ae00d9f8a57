// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/stretch.hpp"

namespace faultline {

/// Fills `q_smooth` and `dq_smooth` from the recorded rows, and `dq` where it was not recorded.
void smooth(Stretch& stretch);

}  // namespace faultline
