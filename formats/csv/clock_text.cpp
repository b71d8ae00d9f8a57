// SPDX-License-Identifier: MIT
#include "formats/csv/clock_text.hpp"

#include <cctype>
#include <chrono>
#include <cstdint>

namespace faultline {
namespace {

constexpr int kHours = 24, kHalfDayHours = 12, kSixty = 60;
constexpr int kYearDigits = 4, kShortDigits = 2;
constexpr int kCentury = 2000;  // of a year with two digits
/// Bytes of the shortest and the longest date or time: "1:02:03" and one with nanoseconds and zone.
constexpr std::size_t kShortestClock = 7, kLongestClock = 48;

bool is_clock_digit(char c) { return c >= '0' && c <= '9'; }

/// A whole number with the digits that it was written with; no digits if there is none.
struct ClockNumber {
  int value = 0;
  int digits = 0;
};

/// Takes parts from the front of a text; sets `ok` to false if one is missing.
struct ClockText {
  std::string_view rest;
  bool ok = true;

  /// Reads at most `most` digits.
  ClockNumber number(int most) {
    ClockNumber read;
    while (read.digits < most && !rest.empty() && is_clock_digit(rest.front())) {
      read.value = 10 * read.value + (rest.front() - '0');
      ++read.digits;
      rest.remove_prefix(1);
    }
    return read;
  }
  int digits(int count) {
    const ClockNumber read = number(count);
    ok = ok && read.digits == count;
    return read.value;
  }
  bool takes(char c) {
    if (rest.empty() || rest.front() != c) return false;
    rest.remove_prefix(1);
    return true;
  }
  void demand(char c) { ok = takes(c) && ok; }
  bool takes_blanks() {
    const std::size_t before = rest.size();
    while (takes(' ')) {
    }
    return rest.size() < before;
  }

  /// Reads h:mm:ss or hh:mm:ss; returns seconds. The second may be 60 (leap second).
  std::int64_t time_of_day() {
    const ClockNumber hours = number(kShortDigits);
    demand(':');
    const int minutes = digits(kShortDigits);
    demand(':');
    const int seconds = digits(kShortDigits);
    ok = ok && hours.digits > 0 && hours.value < kHours && minutes < kSixty && seconds <= kSixty;
    return (std::int64_t{hours.value} * kSixty + minutes) * kSixty + seconds;
  }
  /// Reads the digits after a decimal sign, if there is one; returns nanoseconds, truncated.
  std::int64_t nanoseconds() {
    if (!takes('.') && !takes(',')) return 0;
    std::int64_t value = 0, scale = 1'000'000'000;
    const std::size_t before = rest.size();
    for (; !rest.empty() && is_clock_digit(rest.front()); rest.remove_prefix(1)) {
      if (scale == 1) continue;
      scale /= 10;
      value += scale * (rest.front() - '0');
    }
    ok = ok && rest.size() < before;
    return value;
  }
  /// Reads AM or PM, if there is one; returns the time of day with it.
  std::int64_t half_of_day(std::int64_t seconds) {
    std::string_view word = rest;
    while (!word.empty() && word.front() == ' ') word.remove_prefix(1);
    if (word.size() < 2 || std::toupper(static_cast<unsigned char>(word[1])) != 'M') return seconds;
    const int half = std::toupper(static_cast<unsigned char>(word[0]));
    if (half != 'A' && half != 'P') return seconds;
    rest = word.substr(2);
    constexpr std::int64_t kHalfDay_s = std::int64_t{kHalfDayHours} * kSixty * kSixty;
    ok = ok && seconds >= kSixty * kSixty && seconds < kHalfDay_s + kSixty * kSixty;
    return seconds % kHalfDay_s + (half == 'P' ? kHalfDay_s : 0);
  }
  /// Reads the time zone; returns seconds east of UTC.
  std::int64_t zone() {
    if (rest.empty() || takes('Z') || takes('z')) return 0;
    const bool west = takes('-');
    if (!west) demand('+');
    const int hours = digits(kShortDigits);
    takes(':');
    const int minutes = rest.empty() ? 0 : digits(kShortDigits);
    return (west ? -1 : 1) * (std::int64_t{hours} * kSixty + minutes) * kSixty;
  }
};

/// Returns the days after 1970-01-01; nullopt if there is no such date.
std::optional<std::int64_t> days_after_1970(int year, int month, int day) {
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                            std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return sys_days(date).time_since_epoch().count();
}

struct ReadDate {
  std::int64_t days = 0;
  DateOrder order = DateOrder::certain;
};

/// A date with the year last; the point means day first.
std::optional<ReadDate> date_of(ClockNumber first, ClockNumber second, int year, char separator,
                                bool day_first) {
  const auto with_day_first = days_after_1970(year, second.value, first.value);
  if (separator == '.') {
    if (!with_day_first) return std::nullopt;
    return ReadDate{*with_day_first, DateOrder::certain};
  }
  const auto with_month_first = days_after_1970(year, first.value, second.value);
  const auto chosen = day_first ? with_day_first : with_month_first;
  if (!chosen) return std::nullopt;
  const bool both = with_day_first && with_month_first;
  return ReadDate{*chosen, both        ? DateOrder::either
                           : day_first ? DateOrder::day_first
                                       : DateOrder::month_first};
}

/// Takes a date from the front of the text; nullopt, and nothing taken, if there is none.
std::optional<ReadDate> take_date(ClockText& text, bool day_first) {
  ClockText at = text;
  const ClockNumber first = at.number(kYearDigits);
  const char separator = at.rest.empty() ? '\0' : at.rest.front();
  if (first.digits == 0 || (separator != '-' && separator != '/' && separator != '.')) return std::nullopt;
  at.demand(separator);
  const ClockNumber second = at.number(kShortDigits);
  at.demand(separator);
  const ClockNumber third = at.number(kYearDigits);
  if (!at.ok || second.digits == 0 || third.digits == 0) return std::nullopt;
  std::optional<ReadDate> date;
  if (first.digits == kYearDigits && third.digits <= kShortDigits) {
    if (const auto days = days_after_1970(first.value, second.value, third.value)) date = ReadDate{*days};
  } else if (first.digits <= kShortDigits && third.digits == kYearDigits) {
    date = date_of(first, second, third.value, separator, day_first);
  } else if (first.digits == kShortDigits && second.digits == kShortDigits && third.digits == kShortDigits) {
    date = date_of(first, second, kCentury + third.value, separator, day_first);
  }
  if (date) text = at;
  return date;
}

}  // namespace

std::optional<ClockReading> read_clock(std::string_view text, bool day_first) {
  if (text.size() < kShortestClock || text.size() > kLongestClock || !is_clock_digit(text.front()))
    return std::nullopt;
  ClockText clock{text};
  ClockReading reading;
  std::int64_t seconds = 0;
  const auto date = take_date(clock, day_first);
  if (date) {
    reading.order = date->order;
    seconds = date->days * kHours * kSixty * kSixty;
    reading.kind = clock.rest.empty() ? ClockKind::date : ClockKind::date_and_time;
    if (clock.rest.empty()) return ClockReading{ClockKind::date, static_cast<double>(seconds), date->order};
    if (!clock.takes('T') && !clock.takes('t') && !clock.takes_blanks()) return std::nullopt;
  }
  const std::int64_t of_day = clock.time_of_day();
  const std::int64_t nanoseconds = clock.nanoseconds();
  seconds += clock.half_of_day(of_day);
  if (date) seconds -= clock.zone();
  if (!clock.ok || !clock.rest.empty()) return std::nullopt;
  reading.seconds = static_cast<double>(seconds) + static_cast<double>(nanoseconds) / 1e9;
  return reading;
}

}  // namespace faultline
