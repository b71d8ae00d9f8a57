// SPDX-License-Identifier: MIT
// Logs that are not what the robot file says. None may end as `converged` with wrong masses, and most are
// named for what they are. The table that is printed is the one of docs/results.md.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline {
namespace {

using testing::ClosedFormRun;
using testing::ClosedFormScara;
using testing::simulate_closed_form;

struct WrongInput {
  std::string name;
  std::vector<std::string> named_by;  ///< any of these words in the result names it
  std::function<void(Log&)> spoil;
};

void scale(std::vector<double>& values, double by) {
  for (double& v : values) v *= by;
}

void scale_motion(Log& log, int j, double by) {
  scale(log.q[j], by);
  scale(log.dq[j], by);
}

void shift_torque(Log& log, int rows) {
  for (auto& tau : log.tau) {
    const std::vector<double> old = tau;
    const int n = static_cast<int>(tau.size());
    for (int k = 0; k < n; ++k) tau[k] = old[std::clamp(k + rows, 0, n - 1)];
  }
}

void saturate(std::vector<double>& values, double share) {
  double largest = 0.0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  for (double& v : values) v = std::clamp(v, -share * largest, share * largest);
}

std::vector<WrongInput> wrong_inputs() {
  constexpr double kDegree = 180.0 / std::numbers::pi;
  std::vector<WrongInput> all;
  const auto add = [&](std::string name, std::vector<std::string> by, std::function<void(Log&)> spoil) {
    all.push_back({std::move(name), std::move(by), std::move(spoil)});
  };
  add("all angles in degrees", {"degrees", "deg"}, [](Log& l) {
    for (int j = 0; j < 2; ++j) scale_motion(l, j, kDegree);
  });
  for (int j = 0; j < 2; ++j)
    add("q and dq of joint " + std::to_string(j + 1) + " in degrees", {"degrees", "in deg"},
        [j](Log& l) { scale_motion(l, j, kDegree); });
  for (int j = 0; j < 2; ++j)
    add("q" + std::to_string(j + 1) + " in degrees", {"degrees", "in deg"},
        [j](Log& l) { scale(l.q[j], kDegree); });
  for (int j = 0; j < 2; ++j)
    add("dq" + std::to_string(j + 1) + " in deg/s", {"deg"}, [j](Log& l) { scale(l.dq[j], kDegree); });
  add("q3 and dq3 in mm", {"mm"}, [](Log& l) { scale_motion(l, 2, 1e3); });
  add("q3 in mm", {"mm"}, [](Log& l) { scale(l.q[2], 1e3); });
  add("dq3 in mm/s", {"mm"}, [](Log& l) { scale(l.dq[2], 1e3); });
  add("time in ms", {"in ms"}, [](Log& l) { scale(l.time, 1e3); });
  add("torques in mN m", {"torque"}, [](Log& l) {
    for (auto& tau : l.tau) scale(tau, 1e3);
  });
  for (int j = 0; j < 3; ++j)
    add("tau" + std::to_string(j + 1) + " in mN m", {"tau", "torque"}, [j](Log& l) { scale(l.tau[j], 1e3); });
  for (int j = 0; j < 3; ++j)
    for (int k = j + 1; k < 3; ++k) {
      const std::string pair = std::to_string(j + 1) + " and " + std::to_string(k + 1);
      add("torques " + pair + " swapped", {"swapped"}, [j, k](Log& l) { std::swap(l.tau[j], l.tau[k]); });
      add("joints " + pair + " swapped", {"swapped"}, [j, k](Log& l) {
        std::swap(l.q[j], l.q[k]);
        std::swap(l.dq[j], l.dq[k]);
      });
    }
  for (int j = 0; j < 3; ++j) {
    const std::string joint = std::to_string(j + 1);
    add("tau" + joint + " with the other sign", {"sign"}, [j](Log& l) { scale(l.tau[j], -1.0); });
    add("q and dq of joint " + joint + " with the other sign", {"sign"},
        [j](Log& l) { scale_motion(l, j, -1.0); });
    add("dq" + joint + " with the other sign", {"sign"}, [j](Log& l) { scale(l.dq[j], -1.0); });
  }
  for (const int rows : {1, 5, 20, -1, -5})
    add("torque shifted by " + std::to_string(rows) + " rows", {"delay", "late"},
        [rows](Log& l) { shift_torque(l, rows); });
  for (int j = 0; j < 3; ++j)
    add("tau" + std::to_string(j + 1) + " constant", {"never changes"},
        [j](Log& l) { l.tau[j].assign(l.tau[j].size(), 1.0); });
  add("joint 2 still", {"never moves"}, [](Log& l) {
    l.q[1].assign(l.q[1].size(), 0.3);
    l.dq[1].assign(l.dq[1].size(), 0.0);
  });
  add("tau1 cut at half its range", {"limit"}, [](Log& l) { saturate(l.tau[0], 0.5); });
  return all;
}

bool masses_are_right(const Identification& id, const ClosedFormScara& scara) {
  const double truth[] = {scara.a(), scara.b(), scara.c(), scara.m3};
  for (int k = 0; k < 4; ++k)
    if (id.base_parameters[k].identifiable && std::abs(id.base_parameters[k].value / truth[k] - 1.0) > 0.05)
      return false;
  return true;
}

std::string words_of(const Identification& id) {
  std::string words = id.reason;
  for (const Issue& issue : id.issues.all()) words += "; " + issue.message;
  for (const ModelTerm& term : id.terms)
    if (term.kept) words += "; " + term.name;
  return words;
}

TEST(WrongInputs, NeverConvergeToWrongMassesAndMostAreNamed) {
  const ClosedFormScara scara;
  ClosedFormRun run;
  run.duration_s = 2.5;
  const Log good = simulate_closed_form(scara, run);
  int named = 0, wrong = 0;
  const std::vector<WrongInput> all = wrong_inputs();
  for (const WrongInput& input : all) {
    Log log = good;
    input.spoil(log);
    MemorySource source(log, "log");
    LogSource* logs[] = {&source};
    Robot robot = preset_robot("RRP");
    std::string status, words;
    bool misled = false;
    try {
      const Identification id = identify(logs, robot);
      status = to_string(id.status);
      words = words_of(id);
      misled = id.status == IdentificationStatus::converged && !masses_are_right(id, scara);
    } catch (const Error& e) {
      status = "refused";
      words = e.what();
    }
    bool found = false;
    for (const std::string& by : input.named_by) found = found || words.find(by) != std::string::npos;
    named += found;
    wrong += misled;
    std::cout << (misled ? "WRONG " : "ok    ") << (found ? "named " : "      ") << input.name << ": "
              << status << "; " << words.substr(0, 220) << "\n";
  }
  std::cout << all.size() << " wrong inputs: " << named << " named, " << wrong
            << " converged to wrong masses\n";
  EXPECT_EQ(wrong, 0);
  EXPECT_GE(named, 30);
}

}  // namespace
}  // namespace faultline
