// SPDX-License-Identifier: MIT
#include "lib/batch/batch_exports.hpp"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <nlohmann/json.hpp>

namespace faultline {
namespace {

using Json = nlohmann::json;

BatchRow row_named(const std::string& log, const std::string& verdict) {
  BatchRow row;
  row.log = log;
  row.verdict = verdict;
  row.rows_used = 998;
  return row;
}

/// A healthy log, a faulty one with a name that is markup, one without a verdict, and one that is no log.
std::vector<BatchRow> four_rows() {
  std::vector<BatchRow> rows = {row_named("day/a.csv", "healthy"), row_named("day/<b>&\".csv", "faulty"),
                                row_named("day/c.csv", "inconclusive"), row_named("day/d.csv", "unusable")};
  rows[0].score = 0.25;
  rows[0].residual_rms = {1.0, 1.5};
  rows[1].faults = {{{FaultKind::locked, 2_joint}, 0.5, 0.625, 2.0, 0.75},
                    {{FaultKind::unknown, Joint()}, 4.0, 4.5, 5.0, 0.5}};
  rows[2].reason = "the robot does not explain the log";
  rows[3].reason = "is empty";
  return rows;
}

TEST(BatchExports, JunitHasATestCaseForEachLog) {
  const std::string text = batch_junit(four_rows());
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.Parse(text.c_str()), tinyxml2::XML_SUCCESS) << text;
  const tinyxml2::XMLElement* suite = xml.FirstChildElement("testsuites")->FirstChildElement("testsuite");
  EXPECT_EQ(suite->IntAttribute("tests"), 4);
  EXPECT_EQ(suite->IntAttribute("failures"), 1);
  EXPECT_EQ(suite->IntAttribute("errors"), 1);
  EXPECT_EQ(suite->IntAttribute("skipped"), 1);
  const tinyxml2::XMLElement* test = suite->FirstChildElement("testcase");
  EXPECT_TRUE(test->NoChildren());
  test = test->NextSiblingElement("testcase");
  EXPECT_STREQ(test->Attribute("name"), "day/<b>&\".csv");
  EXPECT_STREQ(test->FirstChildElement("failure")->Attribute("type"), "locked");
  ASSERT_NE(test->FirstChildElement("failure")->NextSiblingElement("failure"), nullptr);
  test = test->NextSiblingElement("testcase");
  EXPECT_STREQ(test->FirstChildElement("skipped")->Attribute("message"),
               "the robot does not explain the log");
  EXPECT_STREQ(test->NextSiblingElement("testcase")->FirstChildElement("error")->Attribute("message"),
               "is empty");
}

TEST(BatchExports, MultiqcHasATableWithARowForEachLog) {
  const Json json = Json::parse(batch_multiqc(four_rows()));
  EXPECT_EQ(json.at("plot_type"), "table");
  ASSERT_EQ(json.at("data").size(), 4u);
  const Json& healthy = json.at("data").at("day > a.csv");
  EXPECT_EQ(healthy.at("verdict"), "healthy");
  EXPECT_EQ(healthy.at("score"), 0.25);
  EXPECT_EQ(healthy.at("residual"), 1.5);
  EXPECT_FALSE(healthy.contains("onset_s"));
  const Json& faulty = json.at("data").at("day > <b>&\".csv");
  EXPECT_EQ(faulty.at("faults"), "locked 2, unknown");
  EXPECT_EQ(faulty.at("onset_s"), 0.5);
  EXPECT_FALSE(faulty.contains("score")) << "a number that is not known";
  for (const auto& [name, value] : healthy.items()) EXPECT_TRUE(json.at("headers").contains(name)) << name;
}

}  // namespace
}  // namespace faultline
