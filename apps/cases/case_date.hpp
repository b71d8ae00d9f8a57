// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// The date, or where it is empty that of today: of SOURCE_DATE_EPOCH (UTC) where that is set, else by the
/// clock of this machine. Throws Error(usage) for what is no date of the form YYYY-MM-DD.
std::string date_or_today(const std::string& date);

}  // namespace faultline
