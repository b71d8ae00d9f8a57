// SPDX-License-Identifier: MIT
#include "lib/report/stop_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/report/html/html_report.hpp"
#include "lib/report/text.hpp"
#include "tests/report/example_diagnosis.hpp"

namespace faultline {
namespace {

using StopReportJson = nlohmann::ordered_json;

Diagnosis asked_diagnosis() {
  Diagnosis d = healthy_diagnosis();
  StopAnswer stop;
  stop.question = {7.5, "E-Stop <active>"};
  stop.looked_from_s = 2.5;
  stop.moment_s = 1.0;
  stop.first_sign = FirstSign{7.125, 0.375, 2_joint, FaultKind::none, StopSignal::motion_velocity};
  stop.leading = {2_joint, 6.5};
  stop.channels = {
      {StopSignal::motion_velocity, 2_joint, SignalState::changed, 9.0, 3.0, 4.5, "healthy", 7.125},
      {StopSignal::torque, 2_joint, SignalState::not_looked}};
  stop.seen = {{{FaultKind::none, 2_joint}, true, 1.25, "N m", true},
               {{FaultKind::locked, 1_joint}, false, std::nan(""), "", false, "the joint hardly moved"}};
  stop.short_log = ShortLog{5.0, 1.0, {"The log has 5 s."}};
  stop.summary = {"First sign: 7.125 s."};
  stop.not_looked_at = {"Safety circuits."};
  d.stop = stop;
  return d;
}

TEST(StopReport, EveryReportForPeopleHasTitleSummaryNotesAndReach) {
  const Diagnosis d = asked_diagnosis();
  for (const std::string& report : {render_text(d), render_markdown(d), render_html(d)})
    for (const char* part : {"At the stop, 7.500 s", "First sign: 7.125 s.", "The log has 5 s.", "1.25 N m",
                             "the joint hardly moved", "Safety circuits."})
      EXPECT_NE(report.find(part), std::string::npos) << part;
}

TEST(StopReport, ANameOfAColumnIsNoMarkup) {
  EXPECT_EQ(render_html(asked_diagnosis()).find("<active>"), std::string::npos);
}

TEST(StopReport, JsonHoldsTheValuesAndNullsWhereThereAreNone) {
  const auto json = StopReportJson::parse(render_json(asked_diagnosis())).at("stop");
  EXPECT_EQ(json.at("time_s"), 7.5);
  EXPECT_EQ(json.at("first_sign").at("signal"), "motion_velocity");
  EXPECT_EQ(json.at("first_sign").at("kind"), nullptr);
  EXPECT_EQ(json.at("signals").at(0).at("since_s"), 7.125);
  EXPECT_EQ(json.at("signals").at(1).at("value"), nullptr);
  EXPECT_EQ(json.at("runner_up"), nullptr);
  EXPECT_EQ(json.at("could_have_seen").at(0).at("kind"), "torque");
}

TEST(StopReport, WithoutAQuestionNoReportHasASection) {
  Diagnosis d = asked_diagnosis();
  d.stop.reset();
  for (const std::string& report : {render_text(d), render_markdown(d), render_html(d), render_json(d)})
    EXPECT_EQ(report.find("At the stop"), std::string::npos);
}

}  // namespace
}  // namespace faultline
