// SPDX-License-Identifier: MIT
#include "lib/identify/payload_groups.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "lib/core/error.hpp"

namespace faultline {

std::vector<PayloadGroup> group_by_payload(std::span<LogSource* const> logs, const Robot& robot) {
  std::map<std::pair<double, double>, PayloadGroup> groups;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const std::string file = std::filesystem::path(logs[i]->identity().path).filename().string();
    const auto it = robot.payloads.find(file);
    const KnownValue payload = it == robot.payloads.end() ? KnownValue{} : it->second;
    PayloadGroup& group = groups[{payload.value, payload.std}];
    group.payload = payload;
    group.logs.push_back(logs[i]);
    group.index.push_back(i);
  }
  std::vector<PayloadGroup> out;
  for (auto& [key, group] : groups) out.push_back(std::move(group));
  std::stable_partition(out.begin(), out.end(), [](const auto& g) { return g.payload.value == 0.0; });
  if (!out.empty() && out[0].payload.value != 0.0)
    throw Error(ErrorCode::input, logs[0]->identity().path,
                "carries a payload, as every log given does; give at least one log without payload");
  return out;
}

}  // namespace faultline
