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

using Units = std::map<std::string, Unit, std::less<>>;

/// Returns each unit in the form that plain() returns, also by German, French, Spanish and Italian names.
Units known_units() {
  Units units;
  const auto add = [&](Dimension dimension, double factor, std::initializer_list<const char*> names) {
    for (const char* name : names) units.emplace(name, Unit{factor, dimension});
  };
  add(Dimension::none, 1.0, {"", "-", "1"});
  add(Dimension::time, 1.0,
      {"s", "sec", "secs", "sek", "second", "seconds", "sekunden", "seconde", "secondes", "segundo",
       "segundos", "secondi"});
  add(Dimension::time, 1e-3,
      {"ms", "msec", "millisec", "milliseconds", "millisekunden", "millisecondes", "milisegundos",
       "millisecondi", "millis"});
  add(Dimension::time, 1e-6, {"us", "µs", "usec", "microsec", "microseconds", "micros"});
  add(Dimension::time, 1e-9, {"ns", "nsec", "nanosec", "nanoseconds", "nanos"});
  add(Dimension::time, 60.0, {"min"});
  add(Dimension::angle, 1.0, {"rad", "radian", "radians", "radianes", "radianti", "bogenmaß"});
  add(Dimension::angle, 1e-3, {"mrad"});
  add(Dimension::angle, kDegree,
      {"deg", "degree", "degrees", "°", "º", "grad", "degré", "degrés", "grado", "grados", "gradi"});
  add(Dimension::angle, kTurn, {"rev", "turn", "turns"});
  add(Dimension::length, 1.0, {"m", "meter", "metre"});
  add(Dimension::length, 1e-3, {"mm"});
  add(Dimension::length, 1e-2, {"cm"});
  add(Dimension::length, 1e-6, {"um", "µm"});
  add(Dimension::length, 0.0254, {"inch"});
  add(Dimension::angular_speed, 1.0, {"rad/s", "rad/sec", "rads-1", "rads^-1"});
  add(Dimension::angular_speed, 1e-3, {"mrad/s"});
  add(Dimension::angular_speed, kDegree,
      {"deg/s", "deg/sec", "°/s", "°/sec", "grad/s", "degrees/s", "dps", "degps", "degrés/s", "grados/s",
       "gradi/s", "º/s"});
  add(Dimension::angular_speed, kTurn / 60.0,
      {"rpm", "rev/min", "1/min", "u/min", "tr/min", "giri/min", "min-1", "min^-1"});
  add(Dimension::angular_speed, kTurn, {"rev/s"});
  add(Dimension::speed, 1.0, {"m/s"});
  add(Dimension::speed, 1e-3, {"mm/s", "mm/sec"});
  add(Dimension::speed, 1e-2, {"cm/s"});
  add(Dimension::torque, 1.0, {"nm", "n·m", "n-m"});
  add(Dimension::torque, 1e-3, {"mnm"});
  add(Dimension::torque, 1e3, {"knm"});
  add(Dimension::torque, 1e-2, {"ncm"});
  add(Dimension::force, 1.0, {"n"});
  add(Dimension::force, 1e-3, {"mn"});
  add(Dimension::force, 1e3, {"kn"});
  add(Dimension::current, 1.0, {"a"});
  add(Dimension::current, 1e-3, {"ma"});
  add(Dimension::voltage, 1.0, {"v"});
  add(Dimension::voltage, 1e-3, {"mv"});
  add(Dimension::share, 1e-2, {"%", "percent"});
  return units;
}

/// Returns lower case without blanks, '*' and '.', so that "N m" and "N*m" become "nm".
std::string plain(std::string_view unit) {
  std::string text;
  for (const char c : unit)
    if (c != ' ' && c != '*' && c != '.')
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Whether it is a unit even after an underscore; "_m", "_a" or "_min" more often mean something else.
bool is_clear_suffix(std::string_view unit) {
  for (const char* known :
       {"s",      "sec",    "ms",      "msec", "us",    "usec",  "ns",    "nsec", "deg", "micros",
        "millis", "nanos",  "rad",     "mm",   "rpm",   "nm",    "mnm",   "ncm",  "knm", "percent",
        "%",      "degree", "degrees", "dps",  "degps", "rad/s", "deg/s", "mm/s", "m/s"})
    if (plain(unit) == known) return true;
  return false;
}

std::string trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(" \t") - begin + 1));
}

}  // namespace

std::optional<Unit> known_unit(std::string_view unit) {
  static const Units units = known_units();
  const auto found = units.find(plain(unit));
  if (found == units.end()) return std::nullopt;
  return found->second;
}

std::optional<double> si_factor(std::string_view unit) {
  const auto known = known_unit(unit);
  if (!known) return std::nullopt;
  return known->factor;
}

const char* epoch_unit(double time) {
  constexpr double kEarliest_s = 3e8, kLatest_s = 4.2e9;  // 1979 to 2103
  for (const char* unit : {"ms", "us", "ns"}) {
    const double seconds = time * *si_factor(unit);
    if (seconds >= kEarliest_s && seconds <= kLatest_s) return unit;
  }
  return "";
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
