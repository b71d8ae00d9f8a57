// SPDX-License-Identifier: MIT
#include "lib/diagnosis/condition.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/distributions.hpp"
#include "lib/core/number_text.hpp"

namespace faultline {
namespace {

constexpr double kPercent = 100.0;

struct Words {
  const char* what;
  bool is_share;
};

Words words_of(SlowKind kind) {
  switch (kind) {
    case SlowKind::friction:
      return {"friction", true};
    case SlowKind::torque_gain:
      return {"drive torque", true};
    case SlowKind::torque_offset:
      return {"torque offset", false};
    case SlowKind::coloured_torque:
      return {"passing torque", false};
    case SlowKind::tip_mass:
      return {"mass at the tip", false};
  }
  return {"", false};
}

ConditionItem item_of(const SlowEstimate& estimate, const Chain<double>& chain) {
  const SlowKind kind = estimate.state.kind;
  const auto [what, is_share] = words_of(kind);
  const bool is_tip = kind == SlowKind::tip_mass;
  const bool turns = chain.geometry[estimate.state.joint].kind == AxisKind::revolute;
  ConditionItem item;
  item.joint = is_tip ? 0 : estimate.state.joint + 1;
  item.name = is_tip ? to_string(kind) : fmt::format("{}_{}", to_string(kind), item.joint);
  item.what = is_tip ? what : fmt::format("{} of joint {}", what, item.joint);
  item.unit = is_share ? "%" : is_tip ? "kg" : turns ? "N m" : "N";
  const double unit = is_share ? kPercent : 1.0;
  item.value = unit * estimate.value;
  item.ci95 = {unit * (estimate.value - kNormal95 * estimate.std),
               unit * (estimate.value + kNormal95 * estimate.std)};
  item.normal_range = unit * estimate.state.normal_range();
  return item;
}

}  // namespace

std::vector<ConditionItem> condition_of(const std::vector<SlowEstimate>& estimates,
                                        const Chain<double>& chain) {
  std::vector<ConditionItem> items;
  for (const SlowEstimate& estimate : estimates)
    if (!(estimate.state.memory_s > 0.0)) items.push_back(item_of(estimate, chain));
  return items;
}

std::string beyond_normal(const std::vector<ConditionItem>& condition, double ranges) {
  std::string text;
  for (const ConditionItem& item : condition)
    if (item.is_beyond(ranges))
      text += fmt::format("{}{} ({}, normal within {} {})", text.empty() ? "" : ", ", item.what,
                          condition_value_text(item.value, item.unit), digits_text(item.normal_range, 2),
                          item.unit);
  return text;
}

std::string condition_value_text(double value, const std::string& unit) {
  return fmt::format("{}{} {}", value < 0.0 ? "" : "+", value_text(value), unit);
}

}  // namespace faultline
