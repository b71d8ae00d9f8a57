// SPDX-License-Identifier: MIT
#include "lib/log/units.hpp"

#include <cctype>
#include <initializer_list>
#include <map>
#include <numbers>

namespace faultline {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kTurn = 2.0 * std::numbers::pi;

using Factors = std::map<std::string, double, std::less<>>;

/// Each unit as plain() writes it.
Factors known_units() {
  Factors factors;
  const auto add = [&](double factor, std::initializer_list<const char*> names) {
    for (const char* name : names) factors.emplace(name, factor);
  };
  add(1.0, {"", "-", "1"});
  add(1.0, {"s", "sec", "secs", "second", "seconds"});
  add(1e-3, {"ms", "msec", "millisec", "milliseconds"});
  add(1e-6, {"us", "µs", "usec", "microseconds"});
  add(1e-9, {"ns", "nsec", "nanosec", "nanoseconds"});
  add(60.0, {"min"});
  add(1.0, {"rad", "radian", "radians"});
  add(1e-3, {"mrad"});
  add(kDegree, {"deg", "degree", "degrees", "°"});
  add(kTurn, {"rev", "turn", "turns"});
  add(1.0, {"m", "meter", "metre"});
  add(1e-3, {"mm"});
  add(1e-2, {"cm"});
  add(1e-6, {"um", "µm"});
  add(0.0254, {"inch"});
  add(1.0, {"rad/s", "rad/sec"});
  add(kDegree, {"deg/s", "deg/sec", "°/s"});
  add(kTurn / 60.0, {"rpm", "rev/min"});
  add(kTurn, {"rev/s"});
  add(1.0, {"m/s"});
  add(1e-3, {"mm/s", "mm/sec"});
  add(1e-2, {"cm/s"});
  add(1.0, {"nm", "n·m"});
  add(1e-3, {"mnm"});
  add(1e3, {"knm"});
  add(1e-2, {"ncm"});
  add(1.0, {"n"});
  add(1e-3, {"mn"});
  add(1e3, {"kn"});
  add(1.0, {"a", "v"});
  add(1e-3, {"ma", "mv"});
  return factors;
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
  static const Factors factors = known_units();
  const auto found = factors.find(plain(unit));
  if (found == factors.end()) return std::nullopt;
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
