// SPDX-License-Identifier: MIT
#include "formats/mcap/mcap_events.hpp"

#include <nlohmann/json.hpp>

#include "formats/mcap/mcap_stamp.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

/// Levels of foxglove.Log.
constexpr int kInfo = 2, kError = 4;

}  // namespace

McapTopic event_topic() {
  const Json integer{{"type", "integer"}}, text{{"type", "string"}};
  const Json schema{{"title", "foxglove.Log"},
                    {"type", "object"},
                    {"properties",
                     {{"timestamp", mcap_stamp_schema()},
                      {"level", integer},
                      {"message", text},
                      {"name", text},
                      {"file", text},
                      {"line", integer}}}};
  return {"/faultline/diagnosis", "foxglove.Log", "jsonschema", schema.dump(), "json"};
}

std::string event_message(std::int64_t stamp_ns, const LogEvent& event) {
  return Json{{"timestamp", mcap_stamp(stamp_ns)},
              {"level", event.grave ? kError : kInfo},
              {"message", event.text},
              {"name", "faultline"},
              {"file", ""},
              {"line", 0}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace faultline
