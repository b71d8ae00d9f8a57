// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/inspection/inspection.hpp"

namespace faultline {

/// Returns one self-contained page without scripts: the verdicts, the issues, and pictures of all channels.
std::string inspection_page(const std::vector<Inspection>& inspections);

/// Returns pictures of the channels with gaps and stuck stretches shaded; empty without rows. `prefix` makes
/// the names inside them unique to this log.
std::string inspection_figures(const Inspection& inspection, const std::string& prefix);

}  // namespace faultline
