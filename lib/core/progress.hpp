// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

namespace faultline {

/// Callback of long work with its current step and the share done, 0 to 1. May be empty. Never called from
/// two threads at once.
using Progress = std::function<void(const std::string& what, double share)>;

/// Returns the callback for a part of the work, whose shares 0 to 1 become `from` to `to` of the whole.
inline Progress part_of(const Progress& progress, double from, double to) {
  if (!progress) return {};
  return [&progress, from, to](const std::string& what, double share) {
    progress(what, from + (to - from) * share);
  };
}

}  // namespace faultline
