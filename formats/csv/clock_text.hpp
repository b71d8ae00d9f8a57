// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace faultline {

/// What a text such as "2026-05-01" or "12:30:00.125" is.
enum class ClockKind { date, time_of_day, date_and_time };

/// The orders in which a date of three numbers can be read, such as "13/01/2024".
enum class DateOrder { certain, day_first, month_first, either };

/// A date, a time of day or both.
struct ClockReading {
  ClockKind kind = ClockKind::time_of_day;
  double seconds = 0.0;  ///< since 1970 with a date, else since midnight
  DateOrder order = DateOrder::certain;
};

/// Reads a date, a time of day, or both with a 'T' or blanks between them; nullopt for any other text.
///
/// Dates: "2026-05-01", "2026/05/01", "1.5.2026", "01.05.26" (this century), and with '/' or '-' the day and
/// the month in the order that `day_first` gives. Times: hh:mm:ss, with decimals behind a point or a comma,
/// with AM or PM. A date with time may have a zone ("+02:00", "Z"); without one it is UTC.
std::optional<ClockReading> read_clock(std::string_view text, bool day_first);

}  // namespace faultline
