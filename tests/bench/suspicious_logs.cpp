// SPDX-License-Identifier: MIT
// Which of the logs given as healthy learn() would leave out, and what else it would say against them.
// Usage: faultline_suspicious_logs ROBOT.toml LOG...
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "apps/work/robot_log.hpp"
#include "lib/core/error.hpp"
#include "lib/learn/consistent_robot.hpp"
#include "lib/learn/model_caveats.hpp"
#include "lib/log/remembered_source.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

std::string name_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

void judge(const std::string& robot_file, const std::vector<std::string>& paths) {
  const Robot robot = load_robot_file(robot_file);
  std::vector<std::unique_ptr<LogSource>> owners;
  std::vector<LogSource*> sources;
  for (const std::string& path : paths)
    sources.push_back(owners.emplace_back(open_robot_log(path, robot)).get());
  RememberedLogs logs(sources);
  const ExplainedRobot trusted = consistent_robot(logs.sources(), robot, {});
  ModelCaveats doubts = caveats_of(trusted.robot.identification);
  doubts.add({{}, trusted.doubts, {}});
  for (const IdentifiedLog& log : trusted.robot.given)
    fmt::print("{},{}\n", name_of(log.path), log.left_out ? "left out" : "used");
  if (doubts.is_grave()) fmt::print("refused\n");
  for (const std::string& doubt : listed(doubts)) fmt::print("doubt: {}\n", doubt);
}

}  // namespace
}  // namespace faultline

int main(int argc, char** argv) try {
  if (argc < 3)
    throw faultline::Error(faultline::ErrorCode::usage, "faultline_suspicious_logs",
                           "needs ROBOT.toml LOG...");
  faultline::judge(argv[1], {argv + 2, argv + argc});
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
