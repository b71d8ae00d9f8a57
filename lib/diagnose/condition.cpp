// SPDX-License-Identifier: MIT
#include "lib/diagnose/condition.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/core/statistics.hpp"
#include "lib/diagnose/condition_words.hpp"

namespace faultline {
namespace {

ConditionItem item_of(const DayEffect& effect, const Chain& chain) {
  const bool is_share = effect.kind == DayEffectKind::friction || effect.kind == DayEffectKind::torque_gain;
  const bool turns = chain.geometry[effect.joint.index()].kind == AxisKind::revolute;
  ConditionItem item;
  item.joint = effect.joint;
  item.kind = effect.kind;
  item.name = fmt::format("{}_{}", to_string(effect.kind), item.joint);
  item.what = condition_words(item.name);
  item.unit = is_share ? "%" : turns ? "N m" : "N";
  const double unit = is_share ? 100.0 : 1.0;
  item.value = unit * effect.value;
  item.ci95 = {unit * (effect.value - kNormal95 * effect.std),
               unit * (effect.value + kNormal95 * effect.std)};
  item.normal_range = unit * effect.normal_range();
  return item;
}

}  // namespace

std::vector<ConditionItem> condition_of(const std::vector<DayEffect>& day, const Chain& chain) {
  std::vector<ConditionItem> items;
  for (const DayEffect& effect : day) items.push_back(item_of(effect, chain));
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
