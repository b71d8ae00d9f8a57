// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/diagnosis/diagnosis.hpp"

namespace faultline {

/// One self-contained page (no script, nothing loaded from elsewhere) with the content of the text report;
/// the timeline is an SVG. The same Diagnosis gives the same bytes.
std::string render_html(const Diagnosis& diagnosis);

}  // namespace faultline
