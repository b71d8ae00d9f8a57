// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// Returns the date or, if it is empty, today's: from SOURCE_DATE_EPOCH (UTC) if that is set, else from the
/// clock of this machine. Throws Error(usage) for a date not of the form YYYY-MM-DD or an invalid epoch.
std::string date_or_today(const std::string& date);

}  // namespace faultline
