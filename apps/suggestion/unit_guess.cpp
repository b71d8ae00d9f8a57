// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/suggestion/robot_guess.hpp"
#include "lib/log/quality.hpp"
#include "lib/log/time_axis.hpp"
#include "lib/log/units.hpp"
#include "lib/log/velocity_check.hpp"

namespace faultline {
namespace {

constexpr double kNear = 0.15;            // relative, for a ratio to be the one that units give
constexpr double kFastestRadians = 20.0;  // rad/s
constexpr double kRanAway = 4.0;          // factor of the range and speed of a runaway joint
constexpr double kMostMetres = 3.0;
constexpr double kLeastDegrees = 2.0;                     // span of a joint that moves
constexpr double kCarries = 2.0;                          // mean torque by its deviation
constexpr double kSlowestRate = 1.0, kFastestRate = 5e4;  // Hz

bool near(double value, double wanted) { return std::abs(value / wanted - 1.0) < kNear; }

double factor_of(const std::string& unit) { return si_factor(unit).value_or(1.0); }

struct UnitPair {
  const char *position, *velocity;
};

/// Units in which positions and velocities are logged together, the usual ones first.
constexpr UnitPair kPairs[] = {{"", ""},      {"mm", "mm/s"}, {"deg", "deg/s"}, {"deg", ""},   {"", "deg/s"},
                               {"mm", "m/s"}, {"m", "mm/s"},  {"", "rpm"},      {"deg", "rpm"}};

double ratio_of(const UnitPair& pair) { return factor_of(pair.velocity) / factor_of(pair.position); }

bool is_length(const std::string& unit) {
  const auto known = known_unit(unit);
  return known && known->dimension == Dimension::length;
}

bool is_plausible(const UnitPair& pair, const JointNumbers& joint, OtherAngles others) {
  // A runaway joint among others in radians is in radians too.
  const double most = others == OtherAngles::radians ? kRanAway : 1.0;
  const bool others_in_degrees = others == OtherAngles::degrees;
  const double span = joint.span * factor_of(pair.position),
               fastest = joint.fastest * factor_of(pair.velocity);
  const std::string position = pair.position;
  if (is_length(position)) return span < kMostMetres && (joint.carries || position == "m");
  if (position == "deg")
    return joint.span >= kLeastDegrees &&
           (others_in_degrees || joint.largest > kHealthySpan_rad || joint.fastest > kFastestRadians ||
            std::string(pair.velocity).empty());
  return joint.largest < most * kHealthySpan_rad && fastest < most * kFastestRadians;
}

/// Correlation of velocity and torque without its mean: friction makes it positive if both have one sign.
double power_of(const std::vector<double>& dq, const std::vector<double>& tau, double mean) {
  double vv = 0.0, tt = 0.0, vt = 0.0;
  for (std::size_t i = 0; i < std::min(dq.size(), tau.size()); ++i) {
    if (std::isnan(dq[i]) || std::isnan(tau[i])) continue;
    const double torque = tau[i] - mean;
    vv += dq[i] * dq[i], tt += torque * torque, vt += dq[i] * torque;
  }
  return vv > 0.0 && tt > 0.0 ? vt / std::sqrt(vv * tt) : NAN;
}

}  // namespace

JointNumbers joint_numbers(const std::vector<double>& time, const std::vector<double>& q,
                           const std::vector<double>& dq, const std::vector<double>& tau) {
  JointNumbers joint;
  double low = INFINITY, high = -INFINITY, turn = NAN;
  for (const double value : q) low = std::fmin(low, value), high = std::fmax(high, value);
  if (!(low <= high)) return joint;
  joint.span = high - low;
  joint.largest = std::max(std::abs(low), std::abs(high));
  for (const double value : dq) joint.fastest = std::fmax(joint.fastest, std::abs(value));
  const double least = 0.05 * joint.span;
  for (const double value : q) {
    if (std::isnan(value)) continue;
    if (std::isnan(turn)) turn = value;
    if (std::abs(value - turn) <= least) continue;
    joint.path += std::abs(value - turn);
    turn = value;
  }
  VelocityCheck check;
  if (!dq.empty()) check.add(time, q, dq);
  if (const VelocityAgreement velocity = check.result(); velocity.is_one_motion())
    joint.ratio = velocity.factor;
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (const double value : tau)
    if (!std::isnan(value)) sum += value, squares += value * value, count += 1.0;
  joint.power = power_of(dq, tau, sum / count);
  const double mean = sum / count, deviation = std::sqrt(std::max(squares / count - mean * mean, 0.0));
  joint.carries = count > 0.0 && std::abs(mean) > kCarries * deviation && deviation > 0.0;
  return joint;
}

GuessedUnit guess_time_unit(const std::vector<double>& time, const std::vector<JointNumbers>& joints) {
  const double first = time.empty() ? 0.0 : std::abs(time.front()), period = median_step(time);
  constexpr double kSecondsSince1970 = 1e8;
  for (const auto& [unit, factor] : {std::pair{"ns", 1e-9}, {"us", 1e-6}, {"ms", 1e-3}})
    if (first * factor > kSecondsSince1970) return {unit, "the stamps count from 1970 in that unit"};
  for (const bool plain : {true, false})
    for (const auto& [unit, factor] : {std::pair{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}) {
      const double rate = 1.0 / (period * factor);
      if (!(rate > kSlowestRate && rate < kFastestRate)) continue;
      int known = 0, fitting = 0;
      for (const JointNumbers& joint : joints) {
        if (std::isnan(joint.ratio)) continue;
        const double ratio = std::abs(joint.ratio) / factor;
        ++known;
        fitting += near(ratio, 1.0) ||
                   (!plain && (near(ratio, ratio_of(kPairs[3])) || near(ratio, ratio_of(kPairs[4]))));
      }
      if (known > 0 && 2 * fitting > known)
        return {std::string(unit) == "s" ? "" : unit,
                fmt::format("with it the velocity is the derivative of the position, at {:.4g} Hz", rate)};
    }
  if (period < kLongestPeriod_s) return {"", fmt::format("? a row every {:.4g} s is usual", period)};
  for (const auto& [unit, factor] : {std::pair{"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}})
    if (1.0 / (period * factor) > 5.0)
      return {unit, fmt::format("? the rows are {:.4g} apart: {:.4g} Hz is usual", period,
                                1.0 / (period * factor))};
  return {"", "? not determined"};
}

GuessedUnits guess_joint_units(const JointNumbers& joint, double time_factor,
                               const std::string& known_position, const std::string& known_velocity,
                               OtherAngles others) {
  GuessedUnits units;
  const double ratio = std::abs(joint.ratio) / time_factor;
  units.flipped = joint.ratio < 0.0;
  const auto take = [&](const std::string& position, const std::string& velocity, const std::string& why) {
    units.position = {position, why}, units.velocity = {velocity, why};
    units.position_factor = factor_of(position);
  };
  const auto is_as_known = [](const std::string& known, const char* unit) {
    return known.empty() || near(factor_of(known), factor_of(unit));
  };
  if (!std::isnan(ratio))
    for (const UnitPair& pair : kPairs) {
      const bool known =
          is_as_known(known_position, pair.position) && is_as_known(known_velocity, pair.velocity);
      const bool plausible = !known_position.empty() || is_plausible(pair, joint, others);
      if (!near(ratio, ratio_of(pair)) || !known || !plausible) continue;
      take(pair.position, pair.velocity,
           fmt::format("the position changes by {:.4g} for a velocity of 1 in 1 s, and spans {:.4g}", ratio,
                       joint.span));
      return units;
    }
  const bool degrees =
      joint.largest > kHealthySpan_rad || (others == OtherAngles::degrees && joint.span >= kLeastDegrees);
  const std::string large = joint.carries ? "mm" : "deg";
  const std::string position = !known_position.empty() ? known_position : degrees ? large : "";
  take(position,
       known_velocity.empty() && std::isnan(ratio) ? (position.empty() ? "" : position + "/s")
                                                   : known_velocity,
       fmt::format("? only by its span of {:.4g}", joint.span));
  return units;
}

}  // namespace faultline
