// SPDX-License-Identifier: MIT
// Pages on a phone, in the dark and by assistive technology: page_rules.js says what is looked for.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <utility>

#include "lib/core/atomic_file.hpp"
#include "lib/report/html/html_report.hpp"
#include "tests/report/example_details.hpp"
#include "tests/support/chromium.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/skip_unless_installed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

#define NEEDS_CHROMIUM() SKIP_UNLESS_INSTALLED(!chromium_program().empty(), "Chromium is missing")

const std::string kHere = std::string(FAULTLINE_SOURCE_DIR) + "/tests/browser/";
const std::string kSamples = std::string(FAULTLINE_SOURCE_DIR) + "/sample_logs/";
constexpr int kHeight = 900;

/// Shows every plot that is not drawn yet, then back to the top.
void scroll_through(BrowserPage& page) {
  page.evaluate(
      "(async () => { for (const f of document.querySelectorAll('figure')) {"
      "if (f.querySelector('.live canvas')) continue; f.scrollIntoView();"
      "await new Promise(r => requestAnimationFrame(() => setTimeout(r, 10))); } scrollTo(0, 0); })()");
}

/// In one of these the page is opened, to the other its reader changes; which is which alternates.
std::array<bool, 2> dark_or_not(int turn) { return {turn % 2 != 0, turn % 2 == 0}; }

/// Opens a page at a width and in a colour scheme, all of it drawn, with the rules at hand.
void open_at(BrowserPage& page, const std::string& path, int width, bool dark) {
  page.resize(width, kHeight);
  page.prefer_dark(dark);
  page.open(path);
  scroll_through(page);
  page.evaluate(read_file(kHere + "page_rules.js"));
}

std::string listed(const nlohmann::json& lines) {
  std::string text;
  for (const nlohmann::json& line : lines) text += "  " + line.get<std::string>() + "\n";
  return text;
}

void expect_readable(const std::string& path, const std::vector<int>& widths = {320, 390, 768, 1280, 2560}) {
  BrowserPage page;
  int turn = 0;
  for (const int width : widths) {
    const std::array<bool, 2> schemes = dark_or_not(turn++);
    open_at(page, path, width, schemes[0]);
    for (const bool dark : schemes) {
      page.prefer_dark(dark);
      const nlohmann::json found = page.evaluate("pageViolations()");
      EXPECT_EQ(found.size(), 0u) << width << " px, " << (dark ? "dark" : "light") << "\n" << listed(found);
    }
  }
  EXPECT_EQ(page.complaints(), std::vector<std::string>{});
}

/// A page that the program makes.
std::string made_page(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  const std::string path = folder.file("page.html");
  arguments.insert(arguments.end(), {"--html", path});
  const ProgramRun run = run_program(arguments);
  EXPECT_LE(run.status, 1) << run.err;
  return path;
}

TEST(PagesAreReadable, TheReportOfAFaultIsReadable) {
  NEEDS_CHROMIUM();
  const TemporaryFolder folder;
  expect_readable(made_page(
      folder, {"diagnose", kSamples + "golden/logs/torque_loss_2.csv", "--model",
               kSamples + "golden/model-749d7413.json", "--cases", kSamples + "golden/cases-18392bf9.db"}));
}

TEST(PagesAreReadable, AReportOfManyFaultsAndLongNamesIsReadable) {
  NEEDS_CHROMIUM();
  Diagnosis d = hostile_diagnosis();
  for (int i = 0; i < 20; ++i) {
    d.faults.push_back(locked_joint());
    d.faults.back().onset_s = d.faults.back().alarm_s = 4.0 + 0.25 * i;
    d.faults.back().end_s = d.faults.back().onset_s + 0.01;
  }
  d.faults = numbered_by_onset(std::move(d.faults));
  d.log.path = std::string(400, 'n');
  const TemporaryFolder folder;
  ReportDetails details = example_details(d);
  details.curves.details.resize(1);
  for (JointCurves& joint : details.curves.whole.joints) joint.q = joint.dq = {};
  expect_readable(folder.write("report.html", render_html(d, details)), {320, 1280});
}

TEST(PagesAreReadable, TheReportOfAnIdentificationIsReadable) {
  NEEDS_CHROMIUM();
  const TemporaryFolder folder;
  expect_readable(
      made_page(folder, {"identify", kSamples + "bench/healthy_1.csv", kSamples + "bench/healthy_2.csv",
                         "--robot", kSamples + "bench/robot.toml", "-o", folder.file("identified.toml")}));
}

TEST(PagesAreReadable, TheInspectionOfTwoLogsIsReadable) {
  NEEDS_CHROMIUM();
  const TemporaryFolder folder;
  expect_readable(
      made_page(folder, {"inspect", kSamples + "bench/stuck_encoder_3.csv", kSamples + "bench/healthy_1.csv",
                         "--robot", kSamples + "bench/robot.toml"}));
}

TEST(PageRules, FindEachViolation) {
  NEEDS_CHROMIUM();
  const TemporaryFolder folder;
  BrowserPage page;
  open_at(page,
          folder.write("bad.html",
                       "<!DOCTYPE html><html><body><h1>a</h1><h3>b</h3><p style='color:#999'>grey</p>"
                       "<svg width='9' height='9'><rect width='9' height='9'/></svg><table><tr><th>c</th>"
                       "</tr></table><input><button style='width:20px;height:20px'></button>"
                       "<div style='width:50px;overflow:auto'><p style='width:3000px'>w</p></div>"
                       "<a href='#' style='text-decoration:none'>l</a><p style='width:999px'>x</p>"),
          320, false);
  const std::string found = listed(page.evaluate("pageViolations()"));
  for (const char* what :
       {"no language", "no title", "main landmark", "skips a level", "contrast 2.85", "without role or name",
        "without caption", "without scope", "a field without label", "a button without name", "a target of",
        "not scrolled by keys", "only colour tells a link", "scrolls sideways"})
    EXPECT_NE(found.find(what), std::string::npos) << what << "\n" << found;
}

/// The report's layout where it changes, in a form that fonts and versions of the browser do not touch.
TEST(ReportLayout, EqualsTheApprovedLayout) {
  NEEDS_CHROMIUM();
  const TemporaryFolder folder;
  const Diagnosis d = traced_diagnosis();
  const std::string path = folder.write("report.html", render_html(d, example_details(d)));
  BrowserPage page;
  std::string facts;
  int turn = 0;
  for (const int width : {320, 390, 1280}) {
    const std::array<bool, 2> schemes = dark_or_not(turn++);
    open_at(page, path, width, schemes[0]);
    std::array<std::string, 2> of_scheme;
    for (const bool dark : schemes) {
      page.prefer_dark(dark);
      of_scheme[dark] = std::to_string(width) + (dark ? " px, dark\n" : " px, light\n") +
                        listed(page.evaluate("pageFacts()"));
    }
    facts += of_scheme[0] + of_scheme[1];
  }
  const std::string approved = kHere + "approved/report_layout.txt";
  if (std::getenv("FAULTLINE_APPROVE")) write_file(approved, facts);
  EXPECT_EQ(facts, read_file(approved));
}

}  // namespace
}  // namespace faultline
