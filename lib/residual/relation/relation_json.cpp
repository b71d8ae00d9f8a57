// SPDX-License-Identifier: MIT
#include "lib/residual/relation/relation_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr int kRelationMostLags = 100, kMostStride = 10'000;
constexpr std::size_t kMostWindows = 100;

/// Name of a quantity without the number of a joint, such as "tau_meas".
std::string name_of(Quantity quantity) {
  std::string name = to_string(Channel{quantity, 1});
  name.pop_back();
  return name;
}

Quantity quantity_from(const std::string& name, const std::string& where) {
  const auto channel = canonical_channel(name + "1");
  if (channel) return channel->quantity;
  throw Error(ErrorCode::input, where, "has a relation of the unknown signal \"" + name + "\"");
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

bool fits(const SignalRelation& relation, int joints) {
  const bool shape = relation.joint >= 0 && relation.joint < joints && !relation.inputs.empty() &&
                     relation.lags >= 0 && relation.lags <= kRelationMostLags && relation.stride >= 1 &&
                     relation.stride <= kMostStride && relation.rate_limit >= 0.0 &&
                     static_cast<int>(relation.weights.size()) == relation.weights_needed() &&
                     relation.term_low.size() + 1 == relation.weights.size() &&
                     relation.term_high.size() == relation.term_low.size();
  const bool windows =
      !relation.windows.empty() && relation.windows.size() <= kMostWindows &&
      std::all_of(relation.windows.begin(), relation.windows.end(), [](const WindowLimit& w) {
        return w.window_s > 0.0 && w.std > 0.0 && w.limit > 0.0 && w.limit < 1e12;
      });
  const bool rising = std::is_sorted(relation.windows.begin(), relation.windows.end(),
                                     [](const auto& a, const auto& b) { return a.window_s < b.window_s; });
  return shape && windows && rising && relation.period_s > 0.0 && relation.low <= relation.high &&
         relation.offset_range >= 0.0 && relation.gain_range >= 0.0 && relation.gain_range < 1.0 &&
         all_finite(relation.weights) && all_finite(relation.term_low) && all_finite(relation.term_high);
}

nlohmann::json to_json(const SignalRelation& relation) {
  nlohmann::json inputs = nlohmann::json::array(), windows = nlohmann::json::array();
  for (const Quantity input : relation.inputs) inputs.push_back(name_of(input));
  for (const WindowLimit& window : relation.windows)
    windows.push_back({{"window_s", window.window_s}, {"std", window.std}, {"limit", window.limit}});
  return {{"kind", to_string(relation.kind)},
          {"joint", relation.joint + 1},
          {"target", name_of(relation.target)},
          {"inputs", inputs},
          {"lags", relation.lags},
          {"stride", relation.stride},
          {"rate_limit", relation.rate_limit},
          {"period_s", relation.period_s},
          {"weights", relation.weights},
          {"low", relation.low},
          {"high", relation.high},
          {"term_low", relation.term_low},
          {"term_high", relation.term_high},
          {"r2", relation.r2},
          {"windows", windows},
          {"offset_range", relation.offset_range},
          {"gain_range", relation.gain_range}};
}

SignalRelation relation_from_json(const nlohmann::json& json, const std::string& where) {
  SignalRelation relation;
  relation.kind = relation_kind_from(json.at("kind"), where);
  relation.joint = json.at("joint").get<int>() - 1;
  relation.target = quantity_from(json.at("target"), where);
  for (const auto& input : json.at("inputs")) relation.inputs.push_back(quantity_from(input, where));
  relation.lags = json.at("lags");
  relation.stride = json.at("stride");
  relation.rate_limit = json.at("rate_limit");
  relation.period_s = json.at("period_s");
  relation.weights = json.at("weights").get<std::vector<double>>();
  relation.low = json.at("low");
  relation.high = json.at("high");
  relation.term_low = json.at("term_low").get<std::vector<double>>();
  relation.term_high = json.at("term_high").get<std::vector<double>>();
  relation.r2 = json.at("r2");
  for (const auto& window : json.at("windows"))
    relation.windows.push_back({window.at("window_s"), window.at("std"), window.at("limit")});
  relation.offset_range = json.at("offset_range");
  relation.gain_range = json.at("gain_range");
  return relation;
}

}  // namespace

nlohmann::json relations_to_json(const std::vector<SignalRelation>& relations) {
  nlohmann::json list = nlohmann::json::array();
  for (const SignalRelation& relation : relations) list.push_back(to_json(relation));
  return list;
}

std::vector<SignalRelation> relations_from_json(const nlohmann::json& list, int joints,
                                                const std::string& where) {
  std::vector<SignalRelation> relations;
  for (const auto& json : list) {
    relations.push_back(relation_from_json(json, where));
    if (!fits(relations.back(), joints))
      throw Error(
          ErrorCode::input, where,
          fmt::format("has an inconsistent relation between signals (entry {}); learn the model again",
                      relations.size()));
  }
  return relations;
}

}  // namespace faultline
