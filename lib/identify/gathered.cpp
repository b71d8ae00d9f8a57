// SPDX-License-Identifier: MIT
#include "lib/identify/gathered.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/error.hpp"
#include "lib/identify/stretch.hpp"

namespace faultline {
namespace {

constexpr double kStill = 20.0;        ///< times the noise of q: a joint that does not move
constexpr double kLeastMotion = 1e-4;  ///< rad or m
constexpr std::size_t kWindows = 10;   ///< fewer tell nothing

}  // namespace

void gather(std::span<LogSource* const> logs, const Progress& progress, Gathered& gathered,
            Identification& id) {
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (progress) progress("reading", static_cast<double>(i) / static_cast<double>(logs.size()));
    const int log = static_cast<int>(i);
    const auto read = for_each_stretch(*logs[i], log, id.space.joints(), [&](const Stretch& s) {
      gathered.windows.add(s);
      gathered.excerpts.add(s);
      gathered.roughness.add(s);
    });
    const LogIdentity& from = logs[i]->identity();
    id.logs.push_back(
        {from.path, from.sha256, read.rows, gathered.windows.rows_used(log), read.period_s, 0.0});
    id.issues.merge(logs[i]->issues());
  }
  const std::size_t windows = gathered.windows.all().size();
  if (windows < kWindows)
    throw Error(
        ErrorCode::input, logs.empty() ? "" : logs[0]->identity().path,
        fmt::format("gives {} usable windows in all; identification needs at least {}: give longer logs of a "
                    "moving robot",
                    windows, kWindows));
}

Eigen::VectorXd noise_floor(const Roughness& roughness) { return (1e-7 * roughness.range()).cwiseMax(1e-9); }

Eigen::VectorXd first_noise(const Roughness& roughness) {
  Eigen::VectorXd noise = roughness.std();
  for (Eigen::Index c = 0; c < noise.size(); ++c)
    if (std::isnan(noise[c])) noise[c] = 0.005 * roughness.range()[c];
  return noise;
}

std::vector<int> still_joints(const Roughness& roughness) {
  const Eigen::VectorXd noise = roughness.std();
  std::vector<int> still;
  for (int j = 0; j < static_cast<int>(noise.size()) / 2; ++j) {
    const double jitter = std::isnan(noise[j]) ? 0.0 : kStill * noise[j];
    if (roughness.still(j, std::max(jitter, kLeastMotion))) still.push_back(j + 1);
  }
  return still;
}

}  // namespace faultline
