// SPDX-License-Identifier: MIT
#include "lib/diagnose/fault_event.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

FaultEvent from_text(const std::string& text) { return fields_from_json<FaultEvent>(Json::parse(text), ""); }

TEST(FaultEvent, IsReadBackFromItsJson) {
  const FaultEvent event{{FaultKind::locked, 2_joint}, 0.1 + 0.2, 1763710000.073, NAN, 0.75};
  const FaultEvent read = from_text(fields_to_json<Json>(event).dump());
  EXPECT_EQ(read.label, event.label);
  EXPECT_EQ(read.onset_s, event.onset_s);
  EXPECT_EQ(read.alarm_s, event.alarm_s);
  EXPECT_TRUE(std::isnan(read.end_s));
  EXPECT_EQ(read.confidence, event.confidence);
}

TEST(FaultEvent, HasItsRunAndTheTimeOnTheClockOfThatRun) {
  const FaultEvent event{{FaultKind::locked, 2_joint}, 12.5, 12.6, 14.0, 0.75, 2, 10.25};
  const FaultEvent read = from_text(fields_to_json<Json>(event).dump());
  EXPECT_EQ(read.run, 2);
  EXPECT_EQ(read.clock_offset_s, 10.25);
  EXPECT_EQ(onset_words(read, 0.01), "12.500 s (run 2, 2.250 s on its clock)");
  EXPECT_EQ(clock_words(read, 13.0, 0.01), "13.000 s (2.750 s on its clock)");
  FaultEvent single = read;
  single.run = 0;
  EXPECT_EQ(clock_words(single, 13.0, 0.01), "13.000 s");
}

TEST(FaultEvent, HasNullForAMissingJoint) {
  const Json json = fields_to_json<Json>(FaultEvent{{FaultKind::unknown, Joint()}, 1.0, 1.5, INFINITY, 0.5});
  EXPECT_EQ(json.dump(),
            R"({"kind":"unknown","joint":null,"onset_s":1.0,"alarm_s":1.5,"end_s":null,"confidence":0.5})");
  EXPECT_EQ(fields_from_json<FaultEvent>(json, "").label.joint, Joint());
}

TEST(FaultEvent, AnIncompleteEventOrAnUnknownKindIsRefused) {
  Json json = fields_to_json<Json>(FaultEvent{{FaultKind::locked, 1_joint}, 1.0, 1.0, 2.0, 0.9});
  json["kind"] = "loked";
  EXPECT_THROW(fields_from_json<FaultEvent>(json, ""), Error);
  json.erase("kind");
  EXPECT_THROW(fields_from_json<FaultEvent>(json, ""), nlohmann::json::exception);
}

TEST(FaultEvent, HasTheLabelTimesAndConfidenceOfItsFinding) {
  FaultFinding finding;
  finding.label = {FaultKind::locked, 2_joint};
  finding.onset_s = 3.0;
  finding.confidence = 0.9;
  const FaultEvent event = event_of(finding);
  EXPECT_EQ(event.label, finding.label);
  EXPECT_EQ(event.onset_s, 3.0);
  EXPECT_EQ(event.confidence, 0.9);
}

}  // namespace
}  // namespace faultline
