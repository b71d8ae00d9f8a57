// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "formats/log_writer.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/core/atomic_file.hpp"
#include "tests/learn/small_robot.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {

/// A model of the small robot as the files that `faultline learn` writes; learned once for all tests.
class BatchWorld {
 public:
  BatchWorld() {
    static const Learned learned = learn_small();
    write_file(model(), model_to_json(learned.model));
    write_case_base(case_base_path(model()), learned.cases);
    std::filesystem::create_directories(logs());
  }

  std::string model() const { return folder_.file("slide.model"); }
  std::string logs() const { return folder_.file("runs"); }
  std::string file(const std::string& name) const { return folder_.file(name); }

  /// Writes the log of a run into runs/; a faulty one loses its drive in the middle.
  void add_log(const std::string& name, double duration_s, bool faulty, std::uint64_t seed) const {
    SimulationSpec spec = small_run(duration_s);
    if (faulty)
      spec.faults = {
          {FaultKind::free_swinging, 1_joint, duration_s / 2, std::numeric_limits<double>::infinity(), 0, 0}};
    const std::filesystem::path path = std::filesystem::path(logs()) / name;
    std::filesystem::create_directories(path.parent_path());
    write_log(path.string(), simulate(small_robot(), spec, seed).log);
  }

  /// day_1/ with healthy and day_2/ with faulty runs, `count` in all.
  void add_logs(int count, double duration_s = 4.0) const {
    for (int i = 0; i < count; ++i)
      add_log((i % 2 ? "day_2/run_" : "day_1/run_") + std::to_string(i) + ".csv", duration_s, i % 2 == 1,
              100 + static_cast<std::uint64_t>(i));
  }

  std::vector<std::string> command(const std::string& out, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"batch", logs(), "--model", model(), "-o", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

 private:
  TemporaryFolder folder_;
};

/// The bytes of all files below a folder, by name; without what a batch notes for this machine alone.
inline std::map<std::string, std::string> bytes_below(const std::string& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().filename() != "known_logs")
      all[std::filesystem::relative(entry.path(), folder).string()] = read_file(entry.path().string());
  return all;
}

/// Names of the files that only one of the folders has or that differ.
inline std::vector<std::string> differences(const std::string& a, const std::string& b) {
  auto one = bytes_below(a), other = bytes_below(b);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : one)
    if (!other.count(name) || other[name] != bytes) names.push_back(name);
  for (const auto& [name, bytes] : other)
    if (!one.count(name)) names.push_back(name);
  return names;
}

/// Writes a run of the small robot through three points, with a free joint from 2 s on if `faulty`; runs with
/// the same `last_point`, m, have the same motion. Returns its path.
inline std::string write_motion(const TemporaryFolder& folder, const std::string& name, std::uint64_t seed,
                                bool faulty, double last_point = -0.12) {
  SimulationSpec spec = small_run(6.0);
  spec.motion.points = {{-0.30}, {0.0}, {last_point}};
  spec.motion.move_min_s = spec.motion.move_max_s = 1.3;
  spec.motion.dwell_min_s = spec.motion.dwell_max_s = 0.2;
  if (faulty)
    spec.faults = {{FaultKind::free_swinging, 1_joint, 2.0, std::numeric_limits<double>::infinity(), 0, 0}};
  const std::string path = folder.file(name);
  write_log(path, simulate(small_robot(), spec, seed).log);
  return path;
}

}  // namespace faultline
