// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/compare/compare_runs.hpp"

namespace faultline {

/// One self-contained page without scripts: the answer, how the runs were aligned, a table, and of each
/// signal both runs and their difference with the threshold. `turns`: as for to_text().
std::string render_comparison_html(const RunComparison& comparison, const std::vector<char>& turns);

}  // namespace faultline
