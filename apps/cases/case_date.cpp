// SPDX-License-Identifier: MIT
#include "apps/cases/case_date.hpp"

#include <charconv>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string_view>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr std::size_t kLength = 10;  // of YYYY-MM-DD

template <typename Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || number < 0) return {};
  return number;
}

bool is_date(const std::string& text) {
  if (text.size() != kLength || text[4] != '-' || text[7] != '-') return false;
  const std::string_view view = text;
  const auto year = number_in<int>(view.substr(0, 4)), month = number_in<int>(view.substr(5, 2)),
             day = number_in<int>(view.substr(8, 2));
  return year && month && day &&
         std::chrono::year_month_day(std::chrono::year(*year), std::chrono::month(unsigned(*month)),
                                     std::chrono::day(unsigned(*day)))
             .ok();
}

std::string today() {
  const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
  std::time_t now = std::time(nullptr);
  std::tm parts{};
  if (epoch != nullptr && *epoch != '\0') {
    const auto seconds = number_in<long long>(epoch);
    if (!seconds) throw Error(ErrorCode::usage, "SOURCE_DATE_EPOCH", "is not a number of seconds since 1970");
    now = static_cast<std::time_t>(*seconds);
    gmtime_r(&now, &parts);
  } else {
    localtime_r(&now, &parts);
  }
  char text[kLength + 1];
  return std::string(text, std::strftime(text, sizeof text, "%Y-%m-%d", &parts));
}

}  // namespace

std::string date_or_today(const std::string& date) {
  if (date.empty()) return today();
  if (!is_date(date))
    throw Error(ErrorCode::usage, "--date", "\"" + date + "\" is not a date; expected YYYY-MM-DD");
  return date;
}

}  // namespace faultline
