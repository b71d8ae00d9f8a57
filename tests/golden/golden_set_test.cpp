// SPDX-License-Identifier: MIT
#include "lib/golden/golden_set.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

GoldenSet example() {
  GoldenSet set;
  set.program_version = "0.1.0";
  set.model_name = "a \"quoted\" \\ name";
  set.joints = 2;
  set.model = {"model-1.json", "aa"};
  set.cases = {"cases-1.db", "bb"};
  set.model_values = {{"model_m 1", 0.5, kNan, "kg"}, {"threshold", 18.0, kNan, "nats"}};
  set.tolerances.by_channel = {{"model_m 1", {1e-5, 0}}, {"dq2", {1e-5, 0.25}}, {"onset_s", {0.15, 0}}};
  GoldenLog log;
  log.log = {"logs/Höhe 1.csv", "cc"};
  log.trace = {"traces/a-1.csv", "dd"};
  log.expected.verdict = "faulty";
  log.expected.rows = 10;
  ObservedEvent event{{{FaultKind::locked, 2_joint}, 1763710000.123456, kNan, INFINITY, 0.9}};
  log.expected.events.push_back(event);
  event.evidence = 123.5;
  event.decided_by = "cases";
  event.opinions = {{{FaultKind::locked, 2_joint}, 0.75}, {{FaultKind::collision, 1_joint}, 0.5}};
  event.could_also_be = {{FaultKind::torque_loss, 2_joint}, {FaultKind::payload_change, Joint()}};
  log.expected.events.push_back(event);
  log.expected.residuals = {{1_joint, 1.25, 2.5, 3.5, kNan}, {2_joint, kNan, kNan, kNan, kNan}};
  log.tolerances.length_may_differ = true;
  set.logs = {log};
  set.identification = GoldenIdentification{{log.name()},
                                            {"converged", "weak_form", {{"l1 m2", 0.5, kNan, "kg m"}}, ""},
                                            {{{"l1 m2", {0.1, 0}}}, {}}};
  return set;
}

TEST(GoldenSet, IsReadBackFromItsText) {
  const std::string text = golden_text(example());
  const GoldenSet read = golden_from_text(text, "golden.toml");
  EXPECT_EQ(golden_text(read), text);
  const GoldenLog& log = read.logs.at(0);
  EXPECT_EQ(log.name(), "Höhe 1.csv");
  EXPECT_DOUBLE_EQ(log.expected.events[0].onset_s, 1763710000.123456);
  EXPECT_TRUE(std::isnan(log.expected.events[0].alarm_s));
  EXPECT_TRUE(std::isinf(log.expected.events[0].end_s));
  const ObservedEvent& event = log.expected.events.at(1);
  EXPECT_EQ(event.evidence, 123.5);
  EXPECT_EQ(event.opinions.rbfn, (Opinion{{FaultKind::collision, 1_joint}, 0.5}));
  EXPECT_EQ(event.could_also_be.at(1), (FaultLabel{FaultKind::payload_change, Joint()}));
  EXPECT_EQ(read.model_values.at(1).value, 18.0);
  EXPECT_EQ(read.model_name, "a \"quoted\" \\ name");
  EXPECT_EQ(read.identification->tolerances.by_channel.at("l1 m2").absolute, 0.1);
  EXPECT_TRUE(log.tolerances.length_may_differ.value());
}

TEST(GoldenSet, ATextCutAnywhereIsRefused) {
  const std::string text = read_file(FAULTLINE_SOURCE_DIR "/sample_logs/golden/golden.toml");
  int refused = 0;
  for (std::size_t end = 0; end<text.size(); end += end> 0 && text[end - 1] == '\n' ? 7 : 1) {
    try {
      golden_from_text(text.substr(0, end), "golden.toml");
      ADD_FAILURE() << "a text cut after byte " << end << " of " << text.size() << " was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input);
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_EQ(golden_from_text(text, "golden.toml").logs.size(), 7u);
}

struct Mistake {
  const char* from;
  const char* to;
  const char* named;
};

TEST(GoldenSet, MistakesAreNamed) {
  const Mistake mistakes[] = {
      {"faultline/golden/2", "faultline/golden/3", "schema"},
      {"log_count = 1", "log_count = 2", "log_count"},
      {"dq2 = {absolute = 1e-05", "dq2 = {absolute = -1", "must not be negative"},
      {"dq2 = {absolute = 1e-05", "dp2 = {absolute = 1e-05", "did you mean \"dq\""},
      {"dq2 = {absolute", "dq2 = {absolut", "did you mean \"absolute\""},
      {"\"locked\"", "\"loked\"", "did you mean \"locked\""},
      {"\"model-1.json\"", "\"/etc/passwd\"", "below the golden folder"},
      {"\"traces/a-1.csv\"", "\"traces/../../a.csv\"", "below the golden folder"},
      {"\"traces/a-1.csv\"", "\"traces//a.csv\"", "below the golden folder"},
      {"\"cases-1.db\"", "\"..\"", "below the golden folder"},
      {"\"cases-1.db\"", "\"cases\\u0000.db\"", "below the golden folder"},
      {"verdict = \"faulty\"", "verdict = \"bad\"", "verdict"},
      {"{joint = 2, velocity_rms", "{joint = 3, velocity_rms", "residuals"},
      {"rows = 10", "rows = -10", "rows"},
      {"confidence = 0.9", "confidence = \"high\"", "confidence"},
      {"trace_points = 500", "trace_points = 0", "trace_points"},
      {"\nvalues = [", "\nmore = [", "values"},
      {", unit = \"kg\"", "", "unit"},
  };
  for (const Mistake& mistake : mistakes) {
    std::string text = golden_text(example());
    const std::size_t at = text.find(mistake.from);
    ASSERT_NE(at, std::string::npos) << mistake.from;
    text.replace(at, std::string(mistake.from).size(), mistake.to);
    try {
      golden_from_text(text, "golden.toml");
      ADD_FAILURE() << mistake.to << " was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input);
      EXPECT_NE(std::string(error.what()).find(mistake.named), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace faultline
