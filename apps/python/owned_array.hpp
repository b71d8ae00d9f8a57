// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <utility>
#include <vector>

namespace faultline {

/// Returns an array that owns the values, which are not copied.
template <typename Value>
pybind11::array_t<Value> owned_array(std::vector<Value>&& values) {
  auto kept = std::make_unique<std::vector<Value>>(std::move(values));
  const auto size = static_cast<pybind11::ssize_t>(kept->size());
  const Value* const data = kept->data();
  const pybind11::capsule owner(kept.release(),
                                [](void* vector) { delete static_cast<std::vector<Value>*>(vector); });
  return pybind11::array_t<Value>(size, data, owner);
}

}  // namespace faultline
