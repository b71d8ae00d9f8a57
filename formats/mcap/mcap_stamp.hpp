// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

namespace faultline {

/// Returns a time as a member of a JSON message, in the form that programs recognise, and its schema.
nlohmann::ordered_json mcap_stamp(std::int64_t stamp_ns);
nlohmann::ordered_json mcap_stamp_schema();

}  // namespace faultline
