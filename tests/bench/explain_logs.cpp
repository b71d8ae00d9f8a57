// SPDX-License-Identifier: MIT
// The regression beside the bank of filters: learns a robot from healthy logs, takes its limits from these
// logs, each left out in turn, and explains other logs. Writes DIR/reports/LOG.json with what score.py and
// living.py read of a diagnosis, and DIR/learn_s, the processor time of learning. Prints a line for each log.
// Usage: faultline_explain_logs ROBOT.toml DIR HEALTHY_LOG... -- LOG...
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "lib/explain/decide_log.hpp"
#include "lib/identify/days/fit_days.hpp"
#include "lib/identify/identify.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Bench {
  OpenLogOptions reading;
  std::filesystem::path out;
  std::vector<std::unique_ptr<LogSource>> healthy;

  std::vector<LogSource*> all_but(std::size_t left_out) const {
    std::vector<LogSource*> logs;
    for (std::size_t k = 0; k < healthy.size(); ++k)
      if (k != left_out) logs.push_back(healthy[k].get());
    return logs;
  }
};

LogFit fit_of(LogSource& log, const BalanceModel& model) {
  log.rewind();
  return {uniform_log(log, model.setting.period_s), model};
}

Json labels_of(const std::vector<FaultLabel>& labels) {
  Json out = Json::array();
  for (const FaultLabel& l : labels) out.push_back({{"kind", to_string(l.kind)}, {"joint", l.joint}});
  return out;
}

std::string best_of(const LogExplanation& e) {
  std::string out;
  for (std::size_t k = 0; k < std::min<std::size_t>(3, e.best.size()); ++k)
    out += fmt::format("  {} {} at {:.3f} s: {:.0f} nats", to_string(e.best[k].kind), e.best[k].joint,
                       e.best[k].onset_s, e.best[k].gain);
  return out;
}

void judge_log(const Bench& bench, const std::string& path, const BalanceModel& model,
               const EvidenceLimits& limits) {
  const double from = processor_s();
  const std::unique_ptr<LogSource> log = open_log(path, bench.reading);
  const LogFit fit = fit_of(*log, model);
  const LogExplanation explanation = explain_log(fit);
  const std::optional<ExplainedFault> fault = decide_log(fit, explanation, limits);
  Json report = {{"verdict", fault ? "faulty" : "healthy"}, {"faults", Json::array()}};
  if (fault)
    report["faults"].push_back({{"kind", to_string(fault->label.kind)},
                                {"joint", fault->label.joint},
                                {"onset_s", fault->onset_s},
                                {"alarm_s", fault->alarm_s},
                                {"evidence", fault->evidence},
                                {"could_also_be", labels_of(fault->could_also_be)}});
  const std::string name = std::filesystem::path(path).filename().string();
  std::ofstream(bench.out / "reports" / (name + ".json")) << report.dump(1) << "\n";
  fmt::print("{} {} left {:.2f}{}, {:.2f} s\n", name, fault ? to_string(fault->label.kind) : "healthy",
             explanation.healthy_square, best_of(explanation), processor_s() - from);
  std::fflush(stdout);
}

int run(const std::string& robot_file, const std::filesystem::path& out,
        const std::vector<std::string>& healthy, const std::vector<std::string>& logs) {
  const Robot robot = load_robot_file(robot_file);
  Bench bench;
  bench.out = out;
  bench.reading.columns = robot.log.columns;
  bench.reading.keep_extra = false;
  std::filesystem::create_directories(out / "reports");
  for (const std::string& log : healthy) bench.healthy.push_back(open_log(log, bench.reading));
  const double from = processor_s();
  const std::vector<LogSource*> all = bench.all_but(healthy.size());
  IdentifyOptions options;
  options.method = IdentifyMethod::weak_form;
  options.threads = 1;
  const Identification identified = identify(all, robot, options);
  DayFitOptions fit;
  fit.torque_is_held = identified.robot.log.torque_between_samples == TorqueTiming::held;
  const BalanceModel model = fit_days(all, identified.space, fit);
  std::vector<LogExplanation> left_out;
  for (std::size_t k = 0; k < healthy.size(); ++k) {
    const BalanceModel others = fit_days(bench.all_but(k), identified.space, fit);
    left_out.push_back(explain_log(fit_of(*bench.healthy[k], others)));
    fmt::print("{} left out: left {:.2f}{}\n", healthy[k], left_out.back().healthy_square,
               best_of(left_out.back()));
  }
  const EvidenceLimits limits = evidence_limits(left_out);
  const double seconds = processor_s() - from;
  std::ofstream(out / "learn_s") << seconds << "\n";
  fmt::print("learned in {:.1f} s of processor time\n", seconds);
  for (const std::string& log : logs) judge_log(bench, log, model, limits);
  return 0;
}

}  // namespace
}  // namespace faultline

int main(int argc, char** argv) try {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto separator = std::find(arguments.begin(), arguments.end(), "--");
  if (arguments.size() < 4 || separator == arguments.end() || separator - arguments.begin() < 4)
    throw faultline::Error(faultline::ErrorCode::usage, "faultline_explain_logs",
                           "needs ROBOT.toml DIR HEALTHY_LOG HEALTHY_LOG... -- LOG...");
  return faultline::run(arguments[0], arguments[1], {arguments.begin() + 2, separator},
                        {separator + 1, arguments.end()});
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
