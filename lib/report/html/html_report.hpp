// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/report/html/report_details.hpp"

namespace faultline {

/// One self-contained page: nothing is loaded from elsewhere, and its Content-Security-Policy forbids it.
/// With `details` it has plots; they are pictures and tables without script and on paper. The same values
/// give the same bytes.
std::string render_html(const Diagnosis& diagnosis, const ReportDetails& details = {});

}  // namespace faultline
