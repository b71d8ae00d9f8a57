// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/inspection/inspection.hpp"

namespace faultline {

/// One self-contained page without scripts: the verdicts, what was found, and pictures of all channels.
std::string inspection_page(const std::vector<Inspection>& inspections);

/// Pictures of the channels, gaps and stretches that stood still shaded; empty without rows. `prefix` makes
/// the names inside them this log's own.
std::string inspection_figures(const Inspection& inspection, const std::string& prefix);

}  // namespace faultline
