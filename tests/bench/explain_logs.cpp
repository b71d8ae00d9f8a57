// SPDX-License-Identifier: MIT
// The regression core beside the bank of filters: learns a robot from healthy logs, leaves each of them out
// in turn for the limits, and explains other logs. Prints one JSON object a log. Usage:
// faultline_explain_logs ROBOT.toml HEALTHY_LOG... -- LOG...
#include <fmt/format.h>

#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "lib/core/statistics.hpp"
#include "lib/explain/coarse/explain_coarse.hpp"
#include "lib/explain/explain.hpp"
#include "lib/identify/days/fit_coarse_days.hpp"
#include "lib/identify/days/fit_days.hpp"
#include "lib/identify/identify.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// `alarm_time(hypothesis, threshold)` says when its evidence passes a threshold.
template <typename AlarmTime>
nlohmann::ordered_json to_json(const LogExplanation& e, double end_s, const AlarmTime& alarm_time) {
  nlohmann::ordered_json out;
  out["chi0"] = e.healthy_square;
  out["slips"] = e.slips;
  out["t_end"] = end_s;
  for (std::size_t k = 0; k < std::min<std::size_t>(8, e.best.size()); ++k) {
    const Hypothesis& h = e.best[k];
    nlohmann::ordered_json one;
    one["kind"] = to_string(h.kind);
    one["joint"] = h.joint;
    one["t0"] = h.onset_s;
    one["gain"] = h.gain;
    one["size"] = std::vector<double>(h.size.data(), h.size.data() + h.size.size());
    one["chi"] = h.fit.mean_square();
    for (const double threshold : {20., 40., 80., 160., 320., 640., 1280.})
      one["al"][fmt::format("{:g}", threshold)] = alarm_time(h, threshold);
    out["hyps"].push_back(one);
  }
  return out;
}

nlohmann::ordered_json explained(LogSource& log, const BalanceModel& model) {
  const LogFit fit(uniform_log(log, model.setting.period_s), model);
  return to_json(explain_log(fit), fit.time_s()[fit.count() - 1],
                 [&](const Hypothesis& h, double threshold) { return alarm_time(fit, h, threshold); });
}

nlohmann::ordered_json explained(LogSource& log, const OneStepModel& model) {
  const CoarseLog fit = coarse_log(uniform_log(log, model.setting.period_s), model);
  return to_json(explain_coarse(fit), fit.end_s(),
                 [&](const Hypothesis& h, double threshold) { return coarse_alarm_time(fit, h, threshold); });
}

template <typename Model>
void explain_file(const std::string& path, const OpenLogOptions& reading, const Model& model,
                  const char* role) {
  const double from = processor_s();
  const std::unique_ptr<LogSource> log = open_log(path, reading);
  nlohmann::ordered_json out = explained(*log, model);
  out["file"] = path;
  out["role"] = role;
  out["cpu_s"] = processor_s() - from;
  fmt::print("{}\n", out.dump());
  std::fflush(stdout);
}

std::vector<double> list(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

void describe(const OneStepModel& m, double seconds) {
  nlohmann::ordered_json out;
  out["role"] = "model";
  out["cpu_s"] = seconds;
  out["theta"] = list(m.theta);
  out["width"] = list(m.body.friction_width());
  out["compliance"] = out["lag"] = out["difference"] = nullptr;  // are no part of such a model
  out["piece_kg"] = 0.0;
  out["payload"] = list(m.payload);
  out["tip_kg"] = m.tip_mass;
  out["day_std"] = list(m.day_variance.cwiseSqrt());
  for (int i = 0; i < m.reading_variance.size(); ++i)
    out["noise"].push_back({std::sqrt(m.reading_variance[i])});
  fmt::print("{}\n", out.dump());
  std::fflush(stdout);
}

void describe(const BalanceModel& m, double seconds) {
  nlohmann::ordered_json out;
  out["role"] = "model";
  out["cpu_s"] = seconds;
  out["theta"] = list(m.theta);
  out["width"] = list(m.setting.friction_width);
  out["compliance"] = list(m.setting.compliance);
  out["fusion"] = list(m.setting.fusion);
  out["lag"] = m.setting.torque_lag;
  out["piece_kg"] = m.piece_kg;
  out["day_std"] = list(m.day_variance.cwiseSqrt());
  out["difference"] = m.setting.velocity_is_difference;
  for (const RippleRate& r : m.setting.ripples) out["ripples"].push_back({r.joint, r.rate});
  for (const JointNoise& n : m.noise.joint)
    out["noise"].push_back({n.base, n.torque, n.rest, n.speed, n.innovation});
  fmt::print("{}\n", out.dump());
  std::fflush(stdout);
}

/// Median sample period of a log, s.
double period_of(LogSource& source) {
  source.rewind();
  const Log log = read_all(source);
  std::vector<double> steps;
  for (int k = 1; k < log.rows(); ++k) steps.push_back(log.time[k] - log.time[k - 1]);
  return upper_median(std::move(steps));
}

/// Learns from all healthy logs, explains each of them by the others, then explains the other logs. `fit`
/// learns from some logs.
template <typename Fit>
void learn_and_explain(const std::vector<LogSource*>& all, const std::vector<std::string>& healthy,
                       const std::vector<std::string>& logs, const OpenLogOptions& reading, const Fit& fit) {
  const double from = processor_s();
  const auto model = fit(all);
  describe(model, processor_s() - from);
  for (std::size_t left_out = 0; left_out < all.size(); ++left_out) {
    std::vector<LogSource*> others;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (k != left_out) others.push_back(all[k]);
    explain_file(healthy[left_out], reading, fit(others), "left_out");
  }
  for (const std::string& log : logs) explain_file(log, reading, model, "test");
}

int run(const std::string& robot_file, const std::vector<std::string>& healthy,
        const std::vector<std::string>& logs) {
  const Robot robot = load_robot_file(robot_file);
  OpenLogOptions reading;
  reading.columns = robot.log.columns;
  reading.keep_extra = false;
  std::vector<std::unique_ptr<LogSource>> owners;
  std::vector<LogSource*> all;
  for (const std::string& log : healthy) {
    owners.push_back(open_log(log, reading));
    all.push_back(owners.back().get());
  }
  const double from = processor_s();
  IdentifyOptions options;
  options.method = IdentifyMethod::weak_form;
  options.threads = 1;
  const Identification identified = identify(all, robot, options);
  fmt::print(stderr, "identify {:.1f} s\n", processor_s() - from);
  const TorqueTiming timing = identified.robot.log.torque_between_samples;
  const bool held = timing == TorqueTiming::held ||
                    (identified.robot.torque_phi && std::abs(*identified.robot.torque_phi) < 0.2);
  if (period_of(*all.front()) > kCoarse_s) {
    learn_and_explain(all, healthy, logs, reading, [&](const std::vector<LogSource*>& some) {
      return fit_coarse_days(some, robot, identified.space, {.torque_is_held = held});
    });
  } else {
    learn_and_explain(all, healthy, logs, reading, [&](const std::vector<LogSource*>& some) {
      return fit_days(some, identified.space, {.torque_is_held = held});
    });
  }
  return 0;
}

}  // namespace
}  // namespace faultline

int main(int argc, char** argv) try {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto separator = std::find(arguments.begin(), arguments.end(), "--");
  if (arguments.size() < 3 || separator == arguments.end())
    throw faultline::Error(faultline::ErrorCode::usage, "faultline_explain_logs",
                           "needs ROBOT.toml HEALTHY_LOG... -- LOG...");
  return faultline::run(arguments[0], {arguments.begin() + 1, separator}, {separator + 1, arguments.end()});
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
