// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

// What the reproduction says about the paper besides numbers, as Markdown.

/// The method in short, and what had to be settled before it could be run.
std::string paper_introduction();
/// The printed equations and counts that cannot be right, and what was used in their place.
std::string paper_errata();

}  // namespace faultline
