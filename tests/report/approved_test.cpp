// SPDX-License-Identifier: MIT
// Renderings against approved files in tests/report/approved/. When a change is wanted, run the tests with
// FAULTLINE_APPROVE=1, look at the difference in version control and commit it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <regex>

#include "lib/core/atomic_file.hpp"
#include "lib/report/html/html_report.hpp"
#include "lib/report/text.hpp"
#include "tests/report/example_diagnosis.hpp"

namespace faultline {
namespace {

std::string approved_path(const std::string& name) {
  return std::string(FAULTLINE_SOURCE_DIR) + "/tests/report/approved/" + name;
}

void expect_approved(const std::string& name, const std::string& text) {
  const std::string path = approved_path(name);
  if (std::getenv("FAULTLINE_APPROVE")) write_file(path, text);
  ASSERT_TRUE(std::filesystem::exists(path)) << path;
  EXPECT_EQ(text, read_file(path)) << "differs from " << path;
}

/// Without what is the same in every page and is looked at in a browser: style and policy.
std::string without_style(const std::string& html) {
  const std::string text =
      std::regex_replace(html, std::regex("Policy\" content=\"[^\"]*"), "Policy\" content=\"");
  const std::size_t from = text.find("<style>") + 7;
  return text.substr(0, from) + text.substr(text.find("</style>", from));
}

void expect_all_approved(const std::string& name, const Diagnosis& diagnosis) {
  expect_approved(name + ".txt", render_text(diagnosis));
  expect_approved(name + ".json", render_json(diagnosis));
  expect_approved(name + ".csv", render_csv(diagnosis));
  expect_approved(name + ".junit.xml", render_junit(diagnosis));
  expect_approved(name + ".html", without_style(render_html(diagnosis)));
  expect_approved(name + ".md", render_markdown(diagnosis));
}

TEST(ApprovedReport, ReportsOfAHealthyDiagnosisEqualTheApprovedOnes) {
  expect_all_approved("healthy", healthy_diagnosis());
}

TEST(ApprovedReport, ReportsOfAFaultyDiagnosisEqualTheApprovedOnes) {
  expect_all_approved("faulty", faulty_diagnosis());
}

TEST(ApprovedReport, ReportsOfAnInconclusiveDiagnosisEqualTheApprovedOnes) {
  expect_all_approved("inconclusive", inconclusive_diagnosis());
}

TEST(ApprovedReport, ReportsWithHostileTextsEqualTheApprovedOnes) {
  expect_all_approved("hostile", hostile_diagnosis());
}

TEST(ApprovedReport, TextReportsInColorAndAsciiEqualTheApprovedOnes) {
  expect_approved("faulty_color.txt", render_text(faulty_diagnosis(), {.color = true}));
  expect_approved("faulty_ascii.txt", render_text(faulty_diagnosis(), {.width = 60, .unicode = false}));
}

}  // namespace
}  // namespace faultline
