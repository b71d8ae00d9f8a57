// SPDX-License-Identifier: MIT
// The pages of faultline serve in a browser, used as a technician would.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "lib/core/atomic_file.hpp"
#include "tests/browser/open_report.hpp"
#include "tests/support/served_folder.hpp"

namespace faultline {
namespace {

const std::string kRules = std::string(FAULTLINE_SOURCE_DIR) + "/tests/browser/page_rules.js";

/// Waits until an expression is true in the page, also over the load of another page.
bool comes_true(BrowserPage& page, const std::string& expression) {
  for (int i = 0; i < 600; ++i) {
    try {
      if (page.evaluate(expression) == true) return true;
    } catch (const std::runtime_error&) {  // between two pages
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

const char* kHasText = "document.body.textContent.includes('%')";

bool shows(BrowserPage& page, const std::string& text) {
  std::string expression = kHasText;
  expression.replace(expression.find('%'), 1, text);
  return comes_true(page, expression);
}

TEST(ServiceInChromium, ADroppedLogIsDiagnosedReadAndStatedAsACase) {
  SKIP_WITHOUT_CHROMIUM();
  const ServedFolder service;
  BrowserPage page;
  page.open_address(service.address() + "/");
  const std::string log = read_file(kServedSamples + "bench/locked_1.csv");
  page.evaluate(
      "(() => { const data = new DataTransfer(); data.items.add(new File([" + nlohmann::json(log).dump() +
      "], 'dropped.csv')); document.querySelector('form.drop').dispatchEvent(new DragEvent('drop', {dataTransfer: "
      "data, bubbles: true, cancelable: true})); })()");
  ASSERT_TRUE(shows(page, "joint 1 is locked, from 8.440 s on"));
  EXPECT_EQ(page.evaluate("document.querySelector('h1').textContent"), "dropped.csv");
  page.evaluate(
      "document.querySelector('summary').click(); document.querySelector('#by-1').value = 'Weber';"
      "document.querySelector('#kind-1').value = 'collision';"
      "document.querySelector('form.case button').click()");
  EXPECT_TRUE(shows(page, "joint 1 was hit or pushed, stated by Weber"));
  page.open_address(service.address() + "/jobs/1/report.html");
  EXPECT_TRUE(comes_true(page, "document.querySelectorAll('figure').length > 3"));
  EXPECT_EQ(page.evaluate("fetch('/').then(() => 'read', () => 'refused')"), "refused")
      << "a report reaches nothing";
}

TEST(ServiceInChromium, ChosenFilesAreSentAndBothVisitorsSeeTheirResult) {
  SKIP_WITHOUT_CHROMIUM();
  const ServedFolder service;
  BrowserPage one, other;
  for (BrowserPage* page : {&one, &other}) {
    page->open_address(service.address() + "/");
    page->choose_files("#logs",
                       {kServedSamples + (page == &one ? "bench/locked_1.csv" : "bench/healthy_1.csv")});
  }
  for (BrowserPage* page : {&one, &other})
    page->evaluate("document.querySelector('form.drop button').click()");
  EXPECT_TRUE(shows(one, "joint 1 is locked, from 8.440 s on"));
  EXPECT_TRUE(shows(other, "the identified robot explains the whole log"));
  EXPECT_EQ(one.complaints(), std::vector<std::string>{});
}

TEST(ServiceInChromium, TwoFilesThatAreOneRunBecomeOneJob) {
  SKIP_WITHOUT_CHROMIUM();
  const ServedFolder service;
  const TemporaryFolder parts;
  const std::string all = read_file(kServedSamples + "bench/locked_1.csv");
  const std::size_t header = all.find('\n') + 1, middle = all.find('\n', all.size() / 2) + 1;
  BrowserPage page;
  page.open_address(service.address() + "/");
  page.choose_files("#logs", {parts.write("part1.csv", all.substr(0, middle)),
                              parts.write("part2.csv", all.substr(0, header) + all.substr(middle))});
  page.evaluate(
      "document.querySelector('#files').value = 'rows';"
      "document.querySelector('form.drop button').click()");
  EXPECT_TRUE(shows(page, "joint 1 is locked, from 8.440 s on"));
  EXPECT_EQ(page.evaluate("document.querySelector('h1').textContent"), "part1.csv and 1 more file");
  EXPECT_EQ(page.complaints(), std::vector<std::string>{});
}

TEST(ServiceInChromium, ALostConnectionIsSaidAndTheFormCanBeSentAgain) {
  SKIP_WITHOUT_CHROMIUM();
  ServedFolder service;
  BrowserPage page;
  page.open_address(service.address() + "/");
  page.choose_files("#logs", {kServedSamples + "bench/locked_1.csv"});
  service.end(SIGKILL);
  page.evaluate("document.querySelector('form.drop button').click()");
  // The text of the body holds the script, and so this sentence from the beginning.
  EXPECT_TRUE(comes_true(
      page,
      "document.querySelector('form.drop [role=status]').textContent.includes('The connection was lost')"));
  EXPECT_EQ(page.evaluate("document.querySelector('form.drop button').disabled"), false);
}

TEST(ServiceInChromium, ReportsAreReadWithoutScript) {
  SKIP_WITHOUT_CHROMIUM();
  const ServedFolder service;
  Visitor visitor(service);
  visitor.result_of(visitor.diagnose("bench/locked_1.csv"));
  BrowserOptions options;
  options.script = false;
  BrowserPage page(options);
  page.open_address(service.address() + "/jobs/1");
  EXPECT_NE(visitor.get("/jobs/1").body.find("href=\"/jobs/1/report.html\""), std::string::npos);
  page.open_address(service.address() + "/jobs/1/report.html");
  EXPECT_GT(page.screenshot().size(), 20000u);
}

void expect_readable(BrowserPage& page, const ServedFolder& service, const std::string& path) {
  for (const auto& [width, dark] : {std::pair{320, true}, std::pair{390, false}, std::pair{1280, false}}) {
    page.resize(width, 900);
    page.prefer_dark(dark);
    page.open_address(service.address() + path);
    page.evaluate("document.querySelectorAll('details').forEach(d => { d.open = true; })");
    page.evaluate(read_file(kRules));
    EXPECT_EQ(page.evaluate("pageViolations()"), nlohmann::json::array())
        << path << ", " << width << " px, " << (dark ? "dark" : "light");
  }
}

TEST(ServiceInChromium, EveryPageIsReadable) {
  SKIP_WITHOUT_CHROMIUM();
  const ServedFolder service;
  Visitor visitor(service);
  for (const char* log : {"bench/healthy_1.csv", "bench/locked_1.csv", "bench/healthy_2.csv"})
    visitor.result_of(visitor.diagnose(log));
  visitor.post("/jobs", {{"key", visitor.key()}, {"kind", "diagnose"}, {"model", "bench.model"}},
               {{"bad.csv", "no log\n"}});
  visitor.result_of("/jobs/4");
  visitor.post("/jobs", {{"key", visitor.key()}, {"kind", "suggest"}}, {sample_log("bench/healthy_1.csv")});
  visitor.result_of("/jobs/5");
  BrowserPage page;
  for (const char* path : {"/", "/robots/bench.model", "/jobs/1", "/jobs/2", "/jobs/4", "/jobs/5", "/learn"})
    expect_readable(page, service, path);
  EXPECT_EQ(page.complaints(), std::vector<std::string>{});
  expect_readable(page, service, "/nowhere");  // the browser itself complains of its status 404
}

TEST(ServiceInChromium, ATechnicianLogsInWithTheToken) {
  SKIP_WITHOUT_CHROMIUM();
  const ServedFolder service({"--address", "0.0.0.0"});
  const std::string messages = service.messages(), before = "shown only now: ";
  BrowserPage page;
  page.open_address(service.address() + "/");
  EXPECT_EQ(page.evaluate("location.pathname"), "/login");
  page.evaluate(read_file(kRules));
  EXPECT_EQ(page.evaluate("pageViolations()"), nlohmann::json::array());
  page.evaluate("document.querySelector('#token').value = '" +
                messages.substr(messages.find(before) + before.size(), 32) +
                "'; document.querySelector('form.case button').click()");
  EXPECT_TRUE(shows(page, "Log out"));
}

}  // namespace
}  // namespace faultline
