// SPDX-License-Identifier: MIT
#include "lib/evidence/slow_state.hpp"

#include <array>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr std::array<const char*, kSlowKinds> kNames = {"friction", "torque_gain", "torque_offset",
                                                        "coloured_torque", "tip_mass"};

}  // namespace

const char* to_string(SlowKind kind) { return kNames[static_cast<std::size_t>(kind)]; }

SlowKind slow_kind_from(const std::string& name, const std::string& where) {
  for (int k = 0; k < kSlowKinds; ++k)
    if (name == kNames[k]) return static_cast<SlowKind>(k);
  throw Error(ErrorCode::input, where, "has the unknown slow state \"" + name + "\"; learn the model again");
}

}  // namespace faultline
