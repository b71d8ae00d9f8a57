// SPDX-License-Identifier: MIT
#include "formats/mcap/mcap_curves.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace faultline {
namespace {

using CurvesJson = nlohmann::ordered_json;

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

}  // namespace

McapTopic curves_topic(const NamedCurves& curves) {
  const CurvesJson integer{{"type", "integer"}};
  CurvesJson members{
      {"timestamp",
       {{"type", "object"}, {"title", "time"}, {"properties", {{"sec", integer}, {"nsec", integer}}}}}};
  for (const std::string& name : curves.names)
    members[name] = {{"type", CurvesJson::array({"number", "null"})}};
  const CurvesJson schema{{"title", curves.topic}, {"type", "object"}, {"properties", members}};
  return {curves.topic, curves.topic.substr(1), "jsonschema", schema.dump(), "json"};
}

std::string curves_message(std::int64_t stamp_ns, const NamedCurves& curves, std::size_t point) {
  CurvesJson message{{"timestamp", {{"sec", stamp_ns / kNsPerSecond}, {"nsec", stamp_ns % kNsPerSecond}}}};
  for (std::size_t i = 0; i < curves.names.size(); ++i) {
    const double value = curves.values[i][point];
    message[curves.names[i]] = std::isfinite(value) ? CurvesJson(value) : CurvesJson(nullptr);
  }
  return message.dump();
}

}  // namespace faultline
