// SPDX-License-Identifier: MIT
#pragma once

#include "lib/explain/log_fit.hpp"

namespace faultline {

/// The noise of a log as its rows before any change show it (free_form()), joint by joint where it is louder
/// than that of the healthy logs: a robot may have what no healthy log had, such as ripple or friction that
/// depends on load, and what it leaves from the first row on is no evidence for a fault that begins later.
RowNoise own_noise(const LogFit& fit);

}  // namespace faultline
