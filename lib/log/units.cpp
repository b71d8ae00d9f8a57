// SPDX-License-Identifier: MIT
#include "lib/log/units.hpp"

#include <cctype>
#include <map>
#include <numbers>

namespace faultline {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kTurn = 2.0 * std::numbers::pi;

const std::map<std::string, double, std::less<>>& factors() {
  static const std::map<std::string, double, std::less<>> table{{"", 1.0},
                                                                {"-", 1.0},
                                                                {"1", 1.0},
                                                                {"s", 1.0},
                                                                {"sec", 1.0},
                                                                {"secs", 1.0},
                                                                {"second", 1.0},
                                                                {"seconds", 1.0},
                                                                {"ms", 1e-3},
                                                                {"msec", 1e-3},
                                                                {"millisec", 1e-3},
                                                                {"milliseconds", 1e-3},
                                                                {"us", 1e-6},
                                                                {"µs", 1e-6},
                                                                {"usec", 1e-6},
                                                                {"microseconds", 1e-6},
                                                                {"ns", 1e-9},
                                                                {"nsec", 1e-9},
                                                                {"nanosec", 1e-9},
                                                                {"nanoseconds", 1e-9},
                                                                {"min", 60.0},
                                                                {"rad", 1.0},
                                                                {"radian", 1.0},
                                                                {"radians", 1.0},
                                                                {"mrad", 1e-3},
                                                                {"deg", kDegree},
                                                                {"degree", kDegree},
                                                                {"degrees", kDegree},
                                                                {"°", kDegree},
                                                                {"rev", kTurn},
                                                                {"turn", kTurn},
                                                                {"turns", kTurn},
                                                                {"m", 1.0},
                                                                {"meter", 1.0},
                                                                {"metre", 1.0},
                                                                {"mm", 1e-3},
                                                                {"cm", 1e-2},
                                                                {"um", 1e-6},
                                                                {"µm", 1e-6},
                                                                {"inch", 0.0254},
                                                                {"rad/s", 1.0},
                                                                {"rad/sec", 1.0},
                                                                {"deg/s", kDegree},
                                                                {"deg/sec", kDegree},
                                                                {"°/s", kDegree},
                                                                {"rpm", kTurn / 60.0},
                                                                {"rev/min", kTurn / 60.0},
                                                                {"rev/s", kTurn},
                                                                {"m/s", 1.0},
                                                                {"mm/s", 1e-3},
                                                                {"cm/s", 1e-2},
                                                                {"mm/sec", 1e-3},
                                                                {"nm", 1.0},
                                                                {"n·m", 1.0},
                                                                {"mnm", 1e-3},
                                                                {"knm", 1e3},
                                                                {"ncm", 1e-2},
                                                                {"n", 1.0},
                                                                {"mn", 1e-3},
                                                                {"kn", 1e3},
                                                                {"a", 1.0},
                                                                {"ma", 1e-3},
                                                                {"v", 1.0},
                                                                {"mv", 1e-3}};
  return table;
}

/// Lower case without blanks and product signs, "N m" and "N*m" becoming "nm".
std::string plain(std::string_view unit) {
  std::string text;
  for (const char c : unit)
    if (c != ' ' && c != '*' && c != '.')
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Units that are one after an underscore too; "_m", "_a" or "_min" more often mean something else.
bool is_clear_suffix(std::string_view unit) {
  for (const char* known :
       {"s", "sec", "ms", "msec", "us", "usec", "ns", "nsec", "deg", "rad", "mm", "rpm", "nm"})
    if (plain(unit) == known) return true;
  return false;
}

std::string trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(" \t") - begin + 1));
}

}  // namespace

std::optional<double> si_factor(std::string_view unit) {
  const auto found = factors().find(plain(unit));
  if (found == factors().end()) return std::nullopt;
  return found->second;
}

NameAndUnit split_unit(std::string_view text) {
  const std::string all = trimmed(text);
  for (const char* pair : {"[]", "()"}) {
    if (all.empty() || all.back() != pair[1]) continue;
    const auto open = all.rfind(pair[0]);
    if (open == std::string::npos || open == 0) continue;
    const std::string unit = trimmed(std::string_view(all).substr(open + 1, all.size() - open - 2));
    const bool index = !unit.empty() && unit.find_first_not_of("0123456789") == std::string::npos;
    const bool part_of_name = pair[0] == '(' && all[open - 1] != ' ' && !si_factor(unit);  // "abs(error)"
    if (!index && !part_of_name) return {trimmed(std::string_view(all).substr(0, open)), unit};
  }
  const auto underscore = all.rfind('_');
  if (underscore != std::string::npos && underscore > 0 && underscore + 1 < all.size()) {
    const std::string unit = all.substr(underscore + 1);
    if (is_clear_suffix(unit)) return {all.substr(0, underscore), unit};
  }
  return {all, ""};
}

}  // namespace faultline
