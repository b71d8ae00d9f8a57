// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace faultline {

/// Seconds that a date and time as ISO 8601 writes it ("2026-05-01T12:30:00.125+02:00", with a blank for the
/// T, a decimal comma, without a zone = UTC) lies after 1970, or a time of day ("12:30:00.125") after
/// midnight; nullopt for any other text.
std::optional<double> clock_seconds(std::string_view text);

}  // namespace faultline
