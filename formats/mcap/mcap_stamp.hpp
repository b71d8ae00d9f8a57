// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

namespace faultline {

/// A time as a member of a JSON message in the form that programs know as a time, and what a schema says of
/// it.
nlohmann::ordered_json mcap_stamp(std::int64_t stamp_ns);
nlohmann::ordered_json mcap_stamp_schema();

}  // namespace faultline
