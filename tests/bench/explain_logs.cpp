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
#include "lib/core/statistics.hpp"
#include "lib/explain/coarse/explain_coarse.hpp"
#include "lib/explain/decide_log.hpp"
#include "lib/explain/explain_faults.hpp"
#include "lib/identify/days/fit_coarse_days.hpp"
#include "lib/identify/days/fit_days.hpp"
#include "lib/identify/identify.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDayEnds_s = 86400.0;  // for a fault that does not end: JSON has no infinity

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The whole log on the grid of the model.
UniformLog whole(LogSource& log, double period_s) {
  log.rewind();
  return uniform_log(log, period_s);
}

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

/// From 50 Hz on: rows of the torque balance.
struct FineCore {
  using Model = BalanceModel;
  ParameterSpace space;
  DayFitOptions options;

  /// The model, and those without each of the logs.
  std::pair<Model, std::vector<Model>> learn(const Bench& bench) const {
    FittedDays fit = fit_days(bench.all_but(bench.healthy.size()), space, options);
    return {std::move(fit.model), std::move(fit.without)};
  }
  static LogExplanation explain(LogSource& log, const Model& model) {
    return explain_log({whole(log, model.setting.period_s), model});
  }
  static std::vector<ExplainedFault> faults(LogSource& log, const Model& model,
                                            const EvidenceLimits& limits) {
    return explain_faults(whole(log, model.setting.period_s), model, limits).faults;
  }
};

/// Below: one-step predictions of the integrated robot.
struct CoarseCore {
  using Model = OneStepModel;
  Robot robot;
  ParameterSpace space;
  CoarseFitOptions options;

  std::pair<Model, std::vector<Model>> learn(const Bench& bench) const {
    std::vector<Model> without;
    for (std::size_t k = 0; k < bench.healthy.size(); ++k)
      without.push_back(fit_coarse_days(bench.all_but(k), robot, space, options));
    return {fit_coarse_days(bench.all_but(bench.healthy.size()), robot, space, options), std::move(without)};
  }
  static LogExplanation explain(LogSource& log, const Model& model) {
    return explain_coarse(coarse_log(whole(log, model.setting.period_s), model));
  }
  /// One fault at most.
  static std::vector<ExplainedFault> faults(LogSource& log, const Model& model,
                                            const EvidenceLimits& limits) {
    return explain_whole_log(whole(log, model.setting.period_s), {model, limits}).faults;
  }
};

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

template <typename Core>
void judge_log(const Bench& bench, const std::string& path, const typename Core::Model& model,
               const EvidenceLimits& limits) {
  const double from = processor_s();
  const std::unique_ptr<LogSource> log = open_log(path, bench.reading);
  const std::vector<ExplainedFault> faults = Core::faults(*log, model, limits);
  Json report = {{"verdict", faults.empty() ? "healthy" : "faulty"}, {"faults", Json::array()}};
  std::string said;
  for (const ExplainedFault& fault : faults) {
    const FaultClaim& claim = fault.claim;
    report["faults"].push_back({{"kind", to_string(claim.kind)},
                                {"joint", claim.joint},
                                {"onset_s", claim.onset_s},
                                {"alarm_s", fault.alarm_s},
                                {"end_s", std::min(claim.end_s, kDayEnds_s)},
                                {"evidence", fault.evidence},
                                {"could_also_be", labels_of(fault.could_also_be)}});
    said += fmt::format("  {} {} {:.3f} to {:.3f} s: {:.0f} nats", to_string(claim.kind), claim.joint,
                        claim.onset_s, claim.end_s, fault.evidence);
  }
  const std::string name = std::filesystem::path(path).filename().string();
  std::ofstream(bench.out / "reports" / (name + ".json")) << report.dump(1) << "\n";
  fmt::print("{} {}{}, {:.2f} s\n", name, faults.empty() ? "healthy" : "faulty", said, processor_s() - from);
  std::fflush(stdout);
}

/// Learns from all healthy logs, takes the limits from each of them explained by the others, explains the
/// rest.
template <typename Core>
void learn_and_explain(const Bench& bench, const Core& core, double from,
                       const std::vector<std::string>& logs) {
  const auto [model, without] = core.learn(bench);
  std::vector<LogExplanation> left_out;
  for (std::size_t k = 0; k < bench.healthy.size(); ++k) {
    left_out.push_back(Core::explain(*bench.healthy[k], without[k]));
    fmt::print("{} left out: left {:.2f}{}\n", bench.healthy[k]->identity().path,
               left_out.back().healthy_square, best_of(left_out.back()));
  }
  const double seconds = processor_s() - from;
  std::ofstream(bench.out / "learn_s") << seconds << "\n";
  fmt::print("learned in {:.1f} s of processor time\n", seconds);
  for (const std::string& log : logs) judge_log<Core>(bench, log, model, evidence_limits(left_out));
}

/// Median sample period, s.
double period_of(LogSource& source) {
  source.rewind();
  const Log log = read_all(source);
  std::vector<double> steps;
  for (int k = 1; k < log.rows(); ++k) steps.push_back(log.time[k] - log.time[k - 1]);
  return upper_median(std::move(steps));
}

int run(const std::string& robot_file, const std::filesystem::path& out,
        const std::vector<std::string>& healthy, const std::vector<std::string>& logs) {
  constexpr double kCoarse_s = 0.02;
  const Robot robot = load_robot_file(robot_file);
  Bench bench;
  bench.out = out;
  bench.reading.columns = robot.log.columns;
  bench.reading.keep_extra = false;
  std::filesystem::create_directories(out / "reports");
  for (const std::string& log : healthy) bench.healthy.push_back(open_log(log, bench.reading));
  const double from = processor_s();
  IdentifyOptions options;
  options.method = IdentifyMethod::weak_form;
  options.threads = 1;
  const std::vector<LogSource*> all = bench.all_but(healthy.size());
  const Identification identified = identify(all, robot, options);
  const bool is_held = identified.robot.log.torque_between_samples == TorqueTiming::held;
  if (period_of(*all.front()) > kCoarse_s)
    learn_and_explain(bench, CoarseCore{robot, identified.space, {.torque_is_held = is_held}}, from, logs);
  else
    learn_and_explain(bench, FineCore{identified.space, {.torque_is_held = is_held}}, from, logs);
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
