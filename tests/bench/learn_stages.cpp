// SPDX-License-Identifier: MIT
// Where `faultline learn` spends its time: processor time by stage, and how often the healthy logs are
// parsed. Usage: faultline_learn_stages ROBOT.toml HEALTHY_LOG...
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "lib/learn/learn.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

/// Counts how often a log is read from its first row.
class CountedSource : public LogSource {
 public:
  explicit CountedSource(std::unique_ptr<LogSource> source) : source_(std::move(source)) {}

  bool next(Log& segment) override {
    passes_ += at_start_;
    at_start_ = false;
    return source_->next(segment);
  }
  void rewind() override {
    at_start_ = true;
    source_->rewind();
  }
  const LogIdentity& identity() const override { return source_->identity(); }
  const Issues& issues() const override { return source_->issues(); }
  double share_read() const override { return source_->share_read(); }
  int passes() const { return passes_; }

 private:
  std::unique_ptr<LogSource> source_;
  bool at_start_ = true;
  int passes_ = 0;
};

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Stage {
  std::string name;
  double processor_s = 0.0;
};

/// Told by learn() what it does; a stage ends where the next begins.
class StageClock {
 public:
  void tell(const std::string& what) {
    const double now = processor_s();
    stages_.back().processor_s += now - since_;
    since_ = now;
    if (stages_.back().name != what) stages_.push_back({what, 0.0});
  }
  const std::vector<Stage>& stages() const { return stages_; }

 private:
  std::vector<Stage> stages_ = {{"opening", 0.0}};
  double since_ = processor_s();
};

int run(const std::string& robot_file, const std::vector<std::string>& logs) {
  const Robot robot = load_robot_file(robot_file);
  OpenLogOptions reading;
  reading.columns = robot.log.columns;
  reading.keep_extra = false;
  std::vector<std::unique_ptr<CountedSource>> owners;
  std::vector<LogSource*> healthy;
  for (const std::string& log : logs) {
    owners.push_back(std::make_unique<CountedSource>(open_log(log, reading)));
    healthy.push_back(owners.back().get());
  }
  StageClock clock;
  LearnOptions options;
  options.threads = 1;
  learn(healthy, {}, robot, options, [&](const std::string& what, double) { clock.tell(what); });
  clock.tell("end");

  double all = 0.0;
  for (const Stage& stage : clock.stages()) all += stage.processor_s;
  fmt::print("| stage | processor time, s | share |\n|---|---|---|\n");
  for (const Stage& stage : clock.stages())
    if (stage.processor_s > 0.0)
      fmt::print("| {} | {:.2f} | {:.0f} % |\n", stage.name, stage.processor_s,
                 100.0 * stage.processor_s / all);
  fmt::print("| all | {:.2f} | |\n", all);
  int most = 0;
  for (const auto& owner : owners) most = std::max(most, owner->passes());
  fmt::print("\nEach log was parsed {} time{}.\n", most, most == 1 ? "" : "s");
  return 0;
}

}  // namespace
}  // namespace faultline

int main(int argc, char** argv) try {
  if (argc < 3)
    throw faultline::Error(faultline::ErrorCode::usage, "faultline_learn_stages", "needs ROBOT.toml LOG...");
  return faultline::run(argv[1], {argv + 2, argv + argc});
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
