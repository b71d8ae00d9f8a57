// SPDX-License-Identifier: MIT
#include "formats/csv/clock_cell.hpp"

#include <chrono>
#include <cstdint>

namespace faultline {
namespace {

constexpr int kHours = 24, kSixty = 60, kMonths = 12, kDays = 31;

/// Takes parts of a text from its front; `ok` turns false where one is not there.
struct ClockText {
  std::string_view rest;
  bool ok = true;

  int digits(std::size_t count) {
    int value = 0;
    if (rest.size() < count) return ok = false, 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (rest[i] < '0' || rest[i] > '9') return ok = false, 0;
      value = 10 * value + (rest[i] - '0');
    }
    rest.remove_prefix(count);
    return value;
  }
  bool takes(char c) {
    if (rest.empty() || rest.front() != c) return false;
    rest.remove_prefix(1);
    return true;
  }
  void demand(char c) { ok = takes(c) && ok; }

  /// Whole seconds of hh:mm:ss; 60 for a leap second.
  std::int64_t time_of_day() {
    const int hours = digits(2);
    demand(':');
    const int minutes = digits(2);
    demand(':');
    const int seconds = digits(2);
    ok = ok && hours < kHours && minutes < kSixty && seconds <= kSixty;
    return (std::int64_t{hours} * kSixty + minutes) * kSixty + seconds;
  }
  /// What stands behind a decimal sign, if there is one: nanoseconds, with digits beyond them left out.
  std::int64_t nanoseconds() {
    if (!takes('.') && !takes(',')) return 0;
    std::int64_t value = 0, scale = 1'000'000'000;
    const std::size_t before = rest.size();
    for (; !rest.empty() && rest.front() >= '0' && rest.front() <= '9'; rest.remove_prefix(1)) {
      if (scale == 1) continue;
      scale /= 10;
      value += scale * (rest.front() - '0');
    }
    ok = ok && rest.size() < before;
    return value;
  }
  /// Seconds east of UTC.
  std::int64_t zone() {
    if (rest.empty() || takes('Z') || takes('z')) return 0;
    const bool west = takes('-');
    if (!west) demand('+');
    const int hours = digits(2);
    takes(':');
    const int minutes = rest.empty() ? 0 : digits(2);
    return (west ? -1 : 1) * (std::int64_t{hours} * kSixty + minutes) * kSixty;
  }
};

std::int64_t days_after_1970(int year, int month, int day) {
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                            std::chrono::day(static_cast<unsigned>(day))};
  return sys_days(date).time_since_epoch().count();
}

}  // namespace

std::optional<double> clock_seconds(std::string_view text) {
  constexpr std::size_t kShortest = 8;  // hh:mm:ss
  if (text.size() < kShortest) return std::nullopt;
  ClockText clock{text};
  std::int64_t seconds = 0;
  const bool dated = text[4] == '-';
  if (dated) {
    const int year = clock.digits(4);
    clock.demand('-');
    const int month = clock.digits(2);
    clock.demand('-');
    const int day = clock.digits(2);
    clock.ok = clock.ok && (clock.takes('T') || clock.takes('t') || clock.takes(' ')) && month >= 1 &&
               month <= kMonths && day >= 1 && day <= kDays;
    if (!clock.ok) return std::nullopt;
    seconds = days_after_1970(year, month, day) * kHours * kSixty * kSixty;
  }
  seconds += clock.time_of_day();
  const std::int64_t nanoseconds = clock.nanoseconds();
  if (dated) seconds -= clock.zone();
  if (!clock.ok || !clock.rest.empty()) return std::nullopt;
  return static_cast<double>(seconds) + static_cast<double>(nanoseconds) / 1e9;
}

}  // namespace faultline
