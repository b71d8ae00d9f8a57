// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "lib/core/error.hpp"
#include "lib/model/model_text.hpp"

namespace faultline {
namespace {

struct Range {
  double low = 0.0, high = 0.0;
};

/// Range of the numbers at a place and at all places below it.
struct PlacedRange {
  std::string_view place;
  Range range;
};

constexpr Range kAnything{-1e15, 1e15}, kPositive{0.0, 1e12}, kSigned{-1e12, 1e12}, kShare{0.0, 1.0},
    kCount{0.0, 1e9}, kNaturalCount{1.0, 1e9}, kJoint{1.0, 64.0}, kJointOrNone{0.0, 64.0}, kSeconds{0.0, 1e4},
    kPeriod{1e-7, 1e4}, kDivisor{1e-15, 1e12}, kExplained{-1e12, 1.0}, kWeight{-1e9, 1e9};

constexpr double kLargestOfRobot = 1e9;  // m, kg, kg m^2, N m

/// Ranges of values that are only reported, never computed with; those that no log determines may be huge.
constexpr Range kReported{-1e100, 1e100}, kReportedPositive{0.0, 1e100};

/// The first matching entry applies.
constexpr std::array kRanges = {
    PlacedRange{"/sample_period_s", kPeriod},
    PlacedRange{"/sources/*/rows", {0.0, 1e15}},
    PlacedRange{"/identification/base_parameters/*/std", kReportedPositive},
    PlacedRange{"/identification/base_parameters", kReported},
    PlacedRange{"/identification/physical_parameters/*/std", kReportedPositive},
    PlacedRange{"/identification/physical_parameters", kReported},
    PlacedRange{"/identification/condition_number", kReportedPositive},
    PlacedRange{"/identification/fit_r2", {-1e100, 1.0}},
    PlacedRange{"/identification/held_out_r2", {-1e100, 1.0}},
    PlacedRange{"/identification/terms/*/joint", kJoint},
    PlacedRange{"/identification/torque_delay_s", {-10.0, 10.0}},
    PlacedRange{"/identification", kReportedPositive},
    PlacedRange{"/twin", {0.0, 1e6}},
    PlacedRange{"/validation/raw_confidence_error", kShare},
    PlacedRange{"/validation/confidence_error", kShare},
    PlacedRange{"/validation/healthy_hours", kCount},
    PlacedRange{"/validation/reach/*/joint", kJointOrNone},
    PlacedRange{"/validation/reach/*/median_delay_s", {-1e6, 1e6}},
    PlacedRange{"/validation/rows/*/median_delay_s", {-1e6, 1e6}},
    PlacedRange{"/validation/rows/*/p90_delay_s", {-1e6, 1e6}},
    PlacedRange{"/validation", kPositive},
    PlacedRange{"/explain/limits", kPositive},
    PlacedRange{"/explain/window_s", kPositive},
    PlacedRange{"/explain/balance/setting/decimation", kNaturalCount},
    PlacedRange{"/explain/balance/setting/torque_lag", {-1e3, 1e3}},
    PlacedRange{"/explain/balance/setting/period_s", kPeriod},
    PlacedRange{"/explain/balance/setting/friction_width", kDivisor},
    PlacedRange{"/explain/balance/setting", kPositive},
    PlacedRange{"/explain/balance/ripples/*/joint", kJoint},
    PlacedRange{"/explain/balance/torque_rms", kDivisor},
    PlacedRange{"/explain/balance/stiction", kPositive},
    PlacedRange{"/explain/balance/drive_limit", kPositive},
    PlacedRange{"/explain/balance/day_variance", kPositive},
    PlacedRange{"/explain/balance/longest_repeat", kCount},
    PlacedRange{"/explain/balance/repeat_share", kShare},
    PlacedRange{"/explain/one_step/setting/period_s", kPeriod},
    PlacedRange{"/explain/one_step/setting/substep_s", kPeriod},
    PlacedRange{"/explain/one_step/friction_width", kDivisor},
    PlacedRange{"/explain/one_step/torque_rms", kDivisor},
    PlacedRange{"/explain/one_step/reading_variance", kPositive},
    PlacedRange{"/explain/one_step/day_variance", kPositive},
    PlacedRange{"/explain/one_step/longest_repeat", kCount},
    PlacedRange{"/explain/one_step/repeat_share", kShare},
    PlacedRange{"/explain", kAnything},
    PlacedRange{"/motion/q_low", {-1e6, 1e6}},
    PlacedRange{"/motion/q_high", {-1e6, 1e6}},
    PlacedRange{"/motion/velocity_scale", kDivisor},
    PlacedRange{"/motion/torque_scale", kDivisor},
    PlacedRange{"/motion", kPositive},
    PlacedRange{"/residual/healthy/patterns", kNaturalCount},
    PlacedRange{"/residual/healthy", kPositive},
    PlacedRange{"/residual/shape/joints", kJoint},
    PlacedRange{"/residual/shape/step", kNaturalCount},
    PlacedRange{"/residual/shape/stride", kNaturalCount},
    PlacedRange{"/residual/shape/step_s", kPeriod},
    PlacedRange{"/residual/shape/torque_phi", {-1.0, 2.0}},
    PlacedRange{"/residual/inputs", kSigned},
    PlacedRange{"/residual/outputs", kSigned},
    PlacedRange{"/residual/mlp", kWeight},
    PlacedRange{"/judges/labels", kJointOrNone},
    PlacedRange{"/judges/rbfn/inverse_radii", {0.0, 1e15}},
    PlacedRange{"/judges/scaler", kSigned},
    PlacedRange{"/judges", kWeight},
    PlacedRange{"/confidence/most", kShare},
    PlacedRange{"/confidence/slope", {0.0, 1e6}},
    PlacedRange{"/confidence/shift", {-1e6, 1e6}},
    PlacedRange{"/samples/classifier/classes/*/joint", kJointOrNone},
    PlacedRange{"/samples/classifier/prior", kShare},
    PlacedRange{"/samples/classifier/rbfn/inverse_radii", {0.0, 1e15}},
    PlacedRange{"/samples/classifier/scaler", kSigned},
    PlacedRange{"/samples/classifier/torque_rms", kPositive},
    PlacedRange{"/samples/classifier", kWeight},
    PlacedRange{"/samples/consecutive/g", kNaturalCount},
    PlacedRange{"/samples/consecutive", kPositive},
    PlacedRange{"/samples/log_odds/g", kNaturalCount},
    PlacedRange{"/samples/log_odds", kPositive},
    PlacedRange{"/relations/*/joint", kJoint},
    PlacedRange{"/relations/*/lags", {0.0, 100.0}},
    PlacedRange{"/relations/*/stride", {1.0, 1e4}},
    PlacedRange{"/relations/*/period_s", kPeriod},
    PlacedRange{"/relations/*/gain_range", kShare},
    PlacedRange{"/relations/*/offset_range", kPositive},
    PlacedRange{"/relations/*/rate_limit", kPositive},
    PlacedRange{"/relations/*/r2", kExplained},
    PlacedRange{"/relations/*/windows", kDivisor},
    PlacedRange{"/relations/*/weights", kAnything},
    PlacedRange{"/relations", kSigned},
};

const PlacedRange* range_of(std::string_view place) {
  for (const PlacedRange& known : kRanges)
    if (place.starts_with(known.place) &&
        (place.size() == known.place.size() || place[known.place.size()] == '/'))
      return &known;
  return nullptr;
}

[[noreturn]] void refuse(const std::string& place, double number, const Range& range,
                         const std::string& where) {
  throw Error(ErrorCode::input, where,
              fmt::format("is a damaged model, or was edited: the number at {} is {}, it must be from {} to "
                          "{}; restore it from a copy or learn it again",
                          place.substr(1), number, range.low, range.high));
}

void check_below(const nlohmann::json& json, std::string& place, const std::string& where) {
  const std::size_t length = place.size();
  if (json.is_number()) {
    const PlacedRange* known = range_of(place);
    const Range range = known ? known->range : kAnything;
    const double number = json.get<double>();
    if (!(number >= range.low && number <= range.high)) refuse(place, number, range, where);
  } else if (json.is_array() || json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      place += "/";
      place += json.is_array() ? "*" : key;
      check_below(value, place, where);
      place.resize(length);
    }
  }
}

}  // namespace

void check_model_ranges(const nlohmann::json& model, const std::string& where) {
  std::string place;
  check_below(model, place, where);
}

void check_robot_ranges(const Robot& robot, const std::string& where) {
  const auto check = [&](const char* what, std::size_t i, double value) {
    if (!(std::abs(value) <= kLargestOfRobot))
      throw Error(
          ErrorCode::input, where,
          fmt::format("is a damaged model, or was edited: the {} of joint {} of its robot is {}; restore "
                      "it from a copy or learn it again",
                      what, i + 1, value));
  };
  const Chain& chain = robot.chain;
  for (std::size_t i = 0; i < chain.geometry.size(); ++i)
    check("place", i, chain.geometry[i].offset.cwiseAbs().maxCoeff());
  for (std::size_t i = 0; i < chain.length.size(); ++i) check("length", i, chain.length[i]);
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    check("mass", i, chain.links[i].mass);
    check("centre of mass", i, chain.links[i].first_moment.cwiseAbs().maxCoeff());
    check("inertia", i, chain.links[i].inertia.cwiseAbs().maxCoeff());
  }
  for (std::size_t i = 0; i < chain.friction.size(); ++i) {
    const Friction& f = chain.friction[i];
    for (const double value : {f.viscous, f.coulomb, f.offset, f.width, f.bend, f.skew, f.bend_width, f.load})
      check("friction", i, value);
  }
  for (std::size_t i = 0; i < chain.rotor_inertia.size(); ++i)
    check("rotor inertia", i, chain.rotor_inertia[i]);
}

bool has_model_range(const std::string& place) { return range_of(place) != nullptr; }

}  // namespace faultline
