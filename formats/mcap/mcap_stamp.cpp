// SPDX-License-Identifier: MIT
#include "formats/mcap/mcap_stamp.hpp"

#include <nlohmann/json.hpp>

namespace faultline {

nlohmann::ordered_json mcap_stamp(std::int64_t stamp_ns) {
  constexpr std::int64_t kNsPerSecond = 1'000'000'000;
  return {{"sec", stamp_ns / kNsPerSecond}, {"nsec", stamp_ns % kNsPerSecond}};
}

nlohmann::ordered_json mcap_stamp_schema() {
  const nlohmann::ordered_json integer{{"type", "integer"}};
  return {{"type", "object"}, {"title", "time"}, {"properties", {{"sec", integer}, {"nsec", integer}}}};
}

}  // namespace faultline
