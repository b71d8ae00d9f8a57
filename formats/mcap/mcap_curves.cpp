// SPDX-License-Identifier: MIT
#include "formats/mcap/mcap_curves.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/mcap/mcap_stamp.hpp"

namespace faultline {

using CurvesJson = nlohmann::ordered_json;

McapTopic curves_topic(const NamedCurves& curves) {
  CurvesJson members{{"timestamp", mcap_stamp_schema()}};
  for (const std::string& name : curves.names)
    members[name] = {{"type", CurvesJson::array({"number", "null"})}};
  const CurvesJson schema{{"title", curves.topic}, {"type", "object"}, {"properties", members}};
  return {curves.topic, curves.topic.substr(1), "jsonschema", schema.dump(), "json"};
}

std::string curves_message(std::int64_t stamp_ns, const NamedCurves& curves, std::size_t point) {
  CurvesJson message{{"timestamp", mcap_stamp(stamp_ns)}};
  for (std::size_t i = 0; i < curves.names.size(); ++i) {
    const double value = curves.values[i][point];
    message[curves.names[i]] = std::isfinite(value) ? CurvesJson(value) : CurvesJson(nullptr);
  }
  return message.dump();
}

}  // namespace faultline
