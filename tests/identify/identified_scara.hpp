// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline::testing {

/// Identified from one log of the closed form at 500 Hz.
inline Identification identified(const ClosedFormScara& scara, double duration_s, ClosedFormRun run = {}) {
  run.period_s = 0.002;
  run.duration_s = duration_s;
  MemorySource source(simulate_closed_form(scara, run), "log");
  LogSource* logs[] = {&source};
  Robot robot = preset_robot("RRP");
  robot.log.torque_between_samples = TorqueTiming::held;
  return identify(logs, robot);
}

/// Whether a term whose name begins so is part of the model.
inline bool kept(const Identification& id, const std::string& prefix) {
  return std::any_of(id.terms.begin(), id.terms.end(),
                     [&](const ModelTerm& t) { return t.name.starts_with(prefix) && t.kept; });
}

/// Expects a, b, c and m3 of the closed form, each within `share` of it.
inline void expect_masses(const Identification& id, const ClosedFormScara& scara, double share) {
  const double truth[] = {scara.a(), scara.b(), scara.c(), scara.m3};
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(id.base_parameters[k].value / truth[k], 1.0, share) << id.base_parameters[k].name;
}

}  // namespace faultline::testing
