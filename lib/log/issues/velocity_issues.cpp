// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "lib/log/channel_names.hpp"
#include "lib/log/issues/quality_issues.hpp"

namespace faultline {
namespace {

constexpr double kDegrees = 57.2958;
constexpr double kRpm = 0.104720;
constexpr double kNear = 0.1;        // relative, of a factor from the one that a unit gives
constexpr double kSameFactor = 0.1;  // relative spread of the joints' factors if they have one common cause

bool near(double factor, double value) { return std::abs(factor / value - 1.0) < kNear; }

std::string guess_of(double factor, bool turns, bool slides) {
  if (factor < 0.0) return "the sign of one of them is wrong";
  if (!slides && near(factor, kDegrees)) return "the position seems to be in degrees, the velocity in rad/s";
  if (!slides && near(factor, 1.0 / kDegrees))
    return "the velocity seems to be in deg/s, the position in rad";
  if (!slides && near(factor, kRpm)) return "the velocity seems to be in rpm, the position in rad";
  if (near(factor, 1e3))
    return turns ? "the velocity's unit is 1000 times too large, or the time is in s and was treated as ms"
                 : "the position seems to be in mm, the velocity in m/s, or the time in s and treated as ms";
  if (near(factor, 1e-3))
    return turns ? "the time seems to be in ms"
                 : "the time seems to be in ms, or the velocity in mm/s and the position in m";
  return "their units, a gear ratio or the sample period differ";
}

bool is_judged(const VelocityAgreement& agreement) {
  return agreement.verdict == VelocityVerdict::agrees || agreement.verdict == VelocityVerdict::scaled;
}

/// Returns the factor between positions and the integrals of velocities that all moving joints, at least two,
/// share; 1 if they share none, or if a joint agrees or contradicts.
double common_factor(const std::vector<VelocityAgreement>& agreements) {
  std::vector<double> factors;
  for (const VelocityAgreement& agreement : agreements) {
    if (agreement.verdict == VelocityVerdict::contradicts || agreement.verdict == VelocityVerdict::agrees)
      return 1.0;
    if (is_judged(agreement)) factors.push_back(agreement.factor);
  }
  if (factors.size() < 2) return 1.0;
  std::sort(factors.begin(), factors.end());
  const double middle = factors[factors.size() / 2];
  if (factors.front() <= 0.0 || factors.back() > (1.0 + kSameFactor) * middle ||
      factors.front() < (1.0 - kSameFactor) * middle)
    return 1.0;
  return middle;
}

/// Whether units of angles explain a factor that all joints share, which requires that none of them slides.
bool is_of_angles(double factor, const QualityOptions& options) {
  const bool some_slide = std::count(options.slides.begin(), options.slides.end(), true) > 0;
  return !some_slide && (near(factor, kDegrees) || near(factor, 1.0 / kDegrees) || near(factor, kRpm));
}

std::string time_guess(double factor, double period_s) {
  for (const auto& [unit, si] : {std::pair{"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}})
    if (near(factor, si)) return fmt::format("the time seems to be in {}, but was treated as s", unit);
  for (const auto& [unit, si] : {std::pair{"ms", 1e3}, {"us", 1e6}, {"ns", 1e9}})
    if (near(factor, si)) return fmt::format("the time seems to be in s, but was treated as {}", unit);
  return fmt::format(
      "the sample period seems to be {:.4g} s, not {:.4g} s: multiply the scale of t by {:.4g}",
      factor * period_s, period_s, factor);
}

void judge_one(const VelocityAgreement& agreement, int joint, const std::string& why, Issues& issues) {
  const std::string channel = to_string({Quantity::dq, joint});
  if (agreement.verdict == VelocityVerdict::scaled)
    issues.add({"velocity_contradicts_position", channel, Severity::severe,
                fmt::format("the position changes {:.4g} times as fast as the velocity: {}", agreement.factor,
                            why)});
  if (agreement.verdict == VelocityVerdict::contradicts)
    issues.add({"velocity_contradicts_position", channel, Severity::warning,
                fmt::format("the velocity does not follow the position (correlation {:.2f}); one of them "
                            "belongs to another joint, or was stuck",
                            agreement.correlation)});
}

}  // namespace

void judge_velocities(const std::vector<VelocityAgreement>& agreements, const TimeAxis& time,
                      const QualityOptions& options, Issues& issues) {
  const double factor = common_factor(agreements);
  const bool all_alike = factor != 1.0 && !is_of_angles(factor, options);
  if (all_alike)
    issues.add({"sample_period_contradicts_motion", "t", Severity::severe,
                fmt::format("the positions of all moving joints change {:.4g} times as fast as their "
                            "velocities: {}; correct it in the robot file: [log.columns] t",
                            factor, time_guess(factor, time.period_s))});
  for (std::size_t j = 0; j < agreements.size(); ++j) {
    const bool known = j < options.slides.size();
    const int joint = static_cast<int>(j) + 1;
    const std::string guess =
        guess_of(agreements[j].factor, known && !options.slides[j], known && options.slides[j]);
    const std::string why = all_alike ? "so do those of all moving joints, see the sample period"
                                      : guess + "; correct it in the robot file: [log.columns] " +
                                            to_string({Quantity::dq, joint});
    judge_one(agreements[j], joint, why, issues);
  }
}

}  // namespace faultline
