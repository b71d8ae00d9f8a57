// SPDX-License-Identifier: MIT
// Errors of the identification and how often its intervals hold the truth, over many runs of a simulated
// SCARA whose controller, noise and motion change from run to run. Usage: faultline_identify_monte_carlo
// [RUNS [PERIOD_S [DURATION_S [weak_form]]]]; defaults 200, 0.001, 10, the method that the program chooses.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace {

using namespace faultline;

struct Errors {
  double square = 0.0, scaled = 0.0;
  int covered = 0, runs = 0;
};

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 200;
  testing::ClosedFormRun run;
  run.period_s = argc > 2 ? std::atof(argv[2]) : 0.001;
  run.duration_s = argc > 3 ? std::atof(argv[3]) : 10.0;
  const bool weak_form = argc > 4 && argv[4] == std::string("weak_form");
  const testing::ClosedFormScara scara;
  std::map<std::string, double> truth = {
      {"a", scara.a()}, {"b", scara.b()}, {"c", scara.c()}, {"m3", scara.m3}};
  for (int j = 0; j < 3; ++j) {
    truth["fv_" + std::to_string(j + 1)] = scara.fv[j];
    truth["fc_" + std::to_string(j + 1)] = scara.fc[j];
  }
  std::map<std::string, Errors> errors;
  std::map<std::string, int> methods;
  std::vector<double> times;
  for (int k = 0; k < runs; ++k) {
    run.seed = 1000 + static_cast<std::uint64_t>(k);
    MemorySource source(testing::simulate_closed_form(scara, run), "log");
    LogSource* logs[] = {&source};
    Robot robot = preset_robot("RRP");
    robot.log.torque_between_samples = TorqueTiming::held;
    IdentifyOptions options;
    options.threads = 1;
    if (weak_form) options.method = IdentifyMethod::weak_form;
    const double begin = seconds();
    const Identification id = identify(logs, robot, options);
    times.push_back(seconds() - begin);
    ++methods[std::string(to_string(id.status)) + " by " + to_string(id.method)];
    for (const ParameterEstimate& e : id.base_parameters) {
      const auto it = truth.find(e.name);
      if (it == truth.end() || !e.identifiable) continue;
      Errors& of = errors[e.name];
      ++of.runs;
      of.covered += e.ci95[0] <= it->second && it->second <= e.ci95[1];
      of.square += std::pow(e.value / it->second - 1.0, 2);
      of.scaled += std::pow((e.value - it->second) / e.std, 2);
    }
  }
  for (const auto& [name, count] : methods) std::cout << count << " of " << runs << " " << name << "\n";
  std::cout
      << "| parameter | rms error | intervals that hold the truth | error / std, rms |\n|---|---|---|---|\n";
  int covered = 0, all = 0;
  for (const auto& [name, e] : errors) {
    std::cout << "| " << name << " | " << 100.0 * std::sqrt(e.square / e.runs) << " % | "
              << 100.0 * e.covered / e.runs << " % | " << std::sqrt(e.scaled / e.runs) << " |\n";
    covered += e.covered;
    all += e.runs;
  }
  std::sort(times.begin(), times.end());
  std::cout << "in all " << 100.0 * covered / std::max(all, 1) << " % of " << all
            << " intervals; processor time median " << times[times.size() / 2] << " s, worst " << times.back()
            << " s\n";
}
