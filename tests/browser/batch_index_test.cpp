// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>

#include "lib/batch/page/index_page.hpp"
#include "lib/report/html/elements.hpp"
#include "tests/support/chromium.hpp"
#include "tests/support/skip_unless_installed.hpp"
#include "tests/support/temporary_folder.hpp"

#define NEEDS_CHROMIUM SKIP_UNLESS_INSTALLED(!chromium_program().empty(), "Chromium is missing")

namespace faultline {
namespace {

/// Every third run faulty, every tenth unusable.
std::vector<BatchRow> rows(int count) {
  std::vector<BatchRow> made;
  for (int i = 0; i < count; ++i) {
    BatchRow row;
    row.log = "runs/robot_" + std::to_string(i % 4) + "/run_" + std::to_string(i) + ".csv";
    row.model_sha256 = i % 4 == 3 ? "bb" : "aa";
    row.verdict = i % 10 == 9 ? "unusable" : i % 3 == 0 ? "faulty" : "healthy";
    if (row.verdict != "unusable") {
      row.result = "run-" + std::to_string(i);
      row.start_s = 0.0;
      row.end_s = 20.0;
      row.joints = 3;
      row.residual_rms = {1.0 + (i * 7 % 100) / 50.0, 1.0, 1.1};
      row.parameters = {{"m1", 2.0 + 0.01 * (i % 5), 0.05, "kg"}};
    }
    if (row.verdict == "faulty")
      row.faults = {
          {{i % 2 ? FaultKind::locked : FaultKind::torque_loss, Joint::at(i % 3)}, 8.0, 8.2, 20.0, 0.9}};
    made.push_back(row);
  }
  return made;
}

std::string page_of(const std::vector<BatchRow>& all) {
  BatchFacts facts;
  facts.models = {{"bench", "aa", "a"}, {"press", "bb", "b"}};
  return render_index_page(all, summary_of(all, facts), false);
}

/// A page that is open, with what a reader does there.
class OpenIndex {
 public:
  explicit OpenIndex(const std::vector<BatchRow>& all, const BrowserOptions& options = {},
                     const std::string& state = "")
      : page(options), address_(folder_.write("index.html", page_of(all)) + state) {
    page.open(address_);
    if (options.script) wait_for_rows();
  }

  /// Loads the page anew, as a reader of such a window has it from the beginning.
  void open_again(int width, int height, bool dark) {
    page.resize(width, height);
    page.prefer_dark(dark);
    page.open(address_);
    wait_for_rows();
  }
  void wait_for_rows() { page.evaluate("Promise.resolve(faultlineIndex.whole).then(() => true)"); }

  void set(const char* id, const char* value) {
    page.evaluate(std::string("(() => {const e = document.getElementById('") + id + "'); e.value = '" +
                  value + "'; e.dispatchEvent(new Event('input'));})()");
  }
  void sort_by(const char* column) {
    page.evaluate("document.querySelector('#logs th button[data-id=" + std::string(column) + "]').click()");
  }
  std::string order_of(const char* column) {
    return page.evaluate("document.querySelector('#logs th:has([data-id=" + std::string(column) +
                         "])').getAttribute('aria-sort')");
  }
  std::string first(const char* column) {
    return page.evaluate("document.querySelector('#logs tbody td." + std::string(column) + "').textContent");
  }
  int shown() { return page.evaluate("parseInt(document.getElementById('shown').textContent)"); }
  /// Scrolled into sight, so that it is drawn.
  void show(const std::string& selector) {
    page.evaluate("new Promise(r => { document.querySelector('" + selector +
                  "').scrollIntoView(); setTimeout(r, 300); })");
  }
  void show_trends() { show("#trends-live"); }
  std::string range() { return page.evaluate("document.getElementById('trends-live').dataset.range"); }
  std::string told() { return page.evaluate("document.querySelector('.told').textContent"); }

  TemporaryFolder folder_;
  BrowserPage page;

 private:
  std::string address_;
};

TEST(BatchIndexInChromium, SortsAndFilters) {
  NEEDS_CHROMIUM;
  OpenIndex index(rows(60));
  EXPECT_EQ(index.shown(), 60);
  index.set("verdict", "unusable");
  EXPECT_EQ(index.shown(), 6);
  index.set("verdict", "");
  index.set("text", "robot_1 run_1");
  EXPECT_EQ(index.shown(), 3);  // 1, 13 and 17
  index.set("text", "");
  index.set("kind", "locked");
  EXPECT_EQ(index.shown(), 8);
  index.set("kind", "");
  index.set("model", "1");
  EXPECT_EQ(index.shown(), 15);
  index.set("model", "");
  index.sort_by("residual");
  EXPECT_EQ(index.first("residual"), "1.1");
  EXPECT_EQ(index.order_of("residual"), "ascending");
  EXPECT_EQ(index.order_of("no"), "none");
  index.sort_by("residual");
  EXPECT_EQ(index.first("residual"), "2.98");
  EXPECT_EQ(index.order_of("residual"), "descending");
  index.set("verdict", "unusable");
  EXPECT_EQ(index.first("residual"), "-");
  EXPECT_EQ(index.page.complaints(), std::vector<std::string>{});
  EXPECT_EQ(index.page.requests().size(), 1u);
}

TEST(BatchIndexInChromium, TheAddressKeepsColumnsOrderAndFilters) {
  NEEDS_CHROMIUM;
  OpenIndex index(rows(60));
  index.page.evaluate("document.querySelector('#choice input[value=timeline]').click()");
  index.page.evaluate("document.querySelector('#choice input[value=peak]').click()");
  index.sort_by("residual");
  index.set("kind", "locked");
  const std::string state = index.page.evaluate("location.hash");
  OpenIndex again(rows(60), {}, state);
  EXPECT_EQ(again.shown(), 8);
  again.show("#logs");
  EXPECT_EQ(again.order_of("residual"), "ascending");
  EXPECT_EQ(again.page.evaluate("document.querySelectorAll('#logs td.timeline').length"), 0);
  EXPECT_GT(again.page.evaluate("document.querySelectorAll('#logs td.peak').length"), 0);
  OpenIndex strange(rows(60), {}, "#sort=%3Cimg&columns=x,y&kind=none&verdict=%22");
  EXPECT_EQ(strange.shown(), 60);
  EXPECT_EQ(strange.page.complaints(), std::vector<std::string>{});
}

TEST(BatchIndexInChromium, TheIndexFitsOnAPhoneWithoutHorizontalScrolling) {
  NEEDS_CHROMIUM;
  auto all = rows(60);
  all[0].log = "runs/" + std::string(300, 'w') + ".csv";
  OpenIndex index(all);
  for (const int width : {320, 390, 768, 1280, 2560}) {
    index.open_again(width, 800, false);
    EXPECT_LE(index.page.evaluate("document.documentElement.scrollWidth"), width);
    if (width > 390) continue;
    index.show("#logs");
    const char* overlap =
        "(() => { const rows = [...document.querySelectorAll('#logs tbody tr:not(.gap)')].map(r => "
        "r.getBoundingClientRect()); return rows.some((r, i) => i && r.top < rows[i - 1].bottom - 1); })()";
    EXPECT_EQ(index.page.evaluate(overlap), false) << width;
    EXPECT_LT(
        index.page.evaluate("document.querySelectorAll('#logs tbody tr')[3].getBoundingClientRect().height"),
        160)
        << width;
    EXPECT_LT(index.page.evaluate("document.documentElement.scrollHeight"), 14000) << width;
  }
}

TEST(BatchIndexInChromium, TrendsZoomByDragKeyAndButton) {
  NEEDS_CHROMIUM;
  OpenIndex index(rows(60));
  index.show_trends();
  const auto press = [&](const char* key) {
    index.page.evaluate("document.querySelector('canvas').focus()");
    index.page.press(key);
  };
  EXPECT_EQ(index.range(), "0.5 54.5");
  index.page.evaluate("document.querySelector('.zoom button').click()");
  EXPECT_EQ(index.range(), "14 41");
  press("Escape");
  EXPECT_EQ(index.range(), "0.5 54.5");
  const nlohmann::json box = index.page.evaluate(
      "(() => { const b = document.querySelector('canvas').getBoundingClientRect(); return "
      "[b.left, b.top, b.width]; })()");
  index.page.drag(box[0].get<double>() + 300.0, box[0].get<double>() + 400.0, box[1].get<double>() + 100.0);
  double from = 0.0, to = 0.0;
  std::sscanf(index.range().c_str(), "%lf %lf", &from, &to);
  EXPECT_NEAR(to - from, 100.0 / (box[2].get<double>() - 62.0) * 54.0, 1e-6);
  index.page.evaluate("document.querySelector('.zoom button:last-of-type').click()");
  press("+");
  EXPECT_NE(index.range(), "0.5 54.5");
}

TEST(BatchIndexInChromium, APointShowsItsLogAndLinksToItsReportAndItsRow) {
  NEEDS_CHROMIUM;
  OpenIndex index(rows(60));
  index.show_trends();
  index.page.evaluate("document.querySelector('canvas').focus()");
  EXPECT_EQ(index.told(),
            "runs/robot_0/run_0.csv, joint 1: 1, joint 1 lost a part of its torque. Show its row");
  index.page.press("ArrowRight");
  index.page.press("ArrowDown");
  EXPECT_EQ(index.told(), "runs/robot_1/run_1.csv, joint 2: 1, healthy. Show its row");
  EXPECT_EQ(index.page.evaluate("document.querySelector('canvas').getAttribute('aria-valuetext')"),
            "runs/robot_1/run_1.csv, joint 2: 1, healthy. ");
  EXPECT_EQ(index.page.evaluate("document.querySelector('.told a').getAttribute('href')"), "logs/run-1.json");
  index.page.press("End");
  index.page.evaluate("document.querySelector('.told button').click()");
  EXPECT_EQ(index.page.evaluate("document.activeElement.textContent"), "runs/robot_2/run_58.csv");
  EXPECT_EQ(index.page.evaluate("document.activeElement.closest('tr').className"), "marked");
  index.set("text", "robot_3");
  index.show_trends();
  index.page.evaluate("document.querySelector('canvas').focus()");
  index.page.press("Home");
  EXPECT_TRUE(index.told().starts_with("runs/robot_3/run_3.csv")) << index.told();
}

TEST(BatchIndexInChromium, AllFoldersAreInTheLegendAndParametersHaveIntervals) {
  NEEDS_CHROMIUM;
  auto all = rows(60);
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i].log = "runs/robot_" + std::to_string(i % 20) + "/run_" + std::to_string(i) + ".csv";
  OpenIndex index(all, {.height = 4000});
  index.show_trends();
  const auto of = [](const char* title) {
    return "[...document.querySelectorAll('figure')].find(f => f.textContent.startsWith('" +
           std::string(title) + "'))";
  };
  EXPECT_EQ(index.page.evaluate(of("Residual by folder") + ".querySelectorAll('.legend button').length"), 18)
      << "two of the robots have no judged log";
  index.page.evaluate(of("Parameters") + ".querySelector('canvas').focus()");
  const std::string told = index.page.evaluate(of("Parameters") + ".querySelector('.told').textContent");
  EXPECT_NE(told.find("(95 %: "), std::string::npos) << told;
}

TEST(BatchIndexInChromium, ATrendWithoutValuesIsNotDrawn) {
  NEEDS_CHROMIUM;
  const auto draws_friction = [](const char* parameter) -> bool {
    std::vector<BatchRow> all = rows(20);
    for (BatchRow& row : all) row.condition = {{parameter, 3.0, 1.0, "%"}};
    OpenIndex index(all);
    index.show_trends();
    return index.page.evaluate(
        "[...document.querySelectorAll('figure')].some(f => f.textContent.startsWith('Friction'))");
  };
  EXPECT_TRUE(draws_friction("friction_2"));
  EXPECT_FALSE(draws_friction("torque_offset_2"));
}

TEST(BatchIndexInChromium, TenThousandLogsOpenFilterAndScrollAndHostileNamesStayText) {
  NEEDS_CHROMIUM;
  auto all = rows(10000);
  all[0].log = "</script><script>document.title='taken'</script>";
  all[1].log = "<img src=http://example.com/x.png onerror=\"document.title='taken'\">";
  all[2].log = std::string(10000, 'w');
  const std::string text = page_of(all);
  EXPECT_LT(text.size(), 4'000'000u);
  const auto start = std::chrono::steady_clock::now();
  OpenIndex index(all);
  EXPECT_EQ(index.shown(), 10000);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_LT(seconds, 15.0) << "measured at less than 1 s on a free machine: tests/bench/index_speed.sh";
  EXPECT_LT(index.page.evaluate("document.querySelectorAll('#logs tr').length"), 1000)
      << "all rows are laid out";
  const double filtered = index.page.evaluate(
      "(() => { const e = document.getElementById('text'), t = performance.now(); e.value = 'run_77'; "
      "e.dispatchEvent(new Event('input')); return performance.now() - t; })()");
  EXPECT_LT(filtered, 2000.0) << "measured at some 30 ms";
  EXPECT_EQ(index.shown(), 111);
  index.set("text", "");
  const char* last =
      "new Promise(r => { scrollTo(0, document.body.scrollHeight); setTimeout(() => r([..."
      "document.querySelectorAll('#logs tbody tr:not(.gap)')].at(-1).dataset.no), 500); })";
  EXPECT_EQ(index.page.evaluate(last), "10000");
  EXPECT_NE(index.page.evaluate("document.title"), "taken");
  EXPECT_EQ(index.page.complaints(), std::vector<std::string>{});
  EXPECT_EQ(index.page.requests().size(), 1u);
}

TEST(BatchIndexInChromium, RowsOfLaterPartsAreFilteredSortedAndShownInTheTrends) {
  NEEDS_CHROMIUM;
  auto all = rows(9001);  // the first rows, and three packed parts
  all[8999].residual_rms = {50.0, 1.0, 1.0};
  all[8999].verdict = "healthy";
  all[8999].result = "last";
  OpenIndex index(all, {}, "#sort=-residual");
  EXPECT_EQ(index.shown(), 9001);
  EXPECT_EQ(index.first("residual"), "50");
  EXPECT_EQ(index.first("no"), "9000");
  index.set("text", "run_8999");
  EXPECT_EQ(index.shown(), 1);
  index.set("text", "");
  EXPECT_EQ(index.range(), "0.5 8102.5") << "nine of ten logs are judged, and the last one, too";
  EXPECT_EQ(index.page.evaluate("document.querySelectorAll('script.part').length"), 0);
}

/// What the page states of its rows once it has taken all that it can.
std::string shown_by(const std::string& page_text) {
  const TemporaryFolder folder;
  BrowserPage page;
  page.open(folder.write("index.html", page_text));
  page.evaluate("Promise.resolve(faultlineIndex.whole).then(() => true)");
  EXPECT_EQ(page.complaints(), std::vector<std::string>{});
  return page.evaluate("document.getElementById('shown').textContent");
}

TEST(BatchIndexInChromium, APageThatWasCutOffShowsTheRowsItHasAndStatesThatSomeAreMissing) {
  NEEDS_CHROMIUM;
  const std::string text = page_of(rows(9000)), part = "<script type=\"text/plain\" class=\"part\">";
  const std::size_t second = text.find(part, text.find(part) + 1);
  EXPECT_EQ(shown_by(text.substr(0, second)),
            "4500 of the first 4500 of 9000 logs; the others are missing in this file: copy it again");
  const std::string in_a_part = shown_by(text.substr(0, second + 1000));
  EXPECT_TRUE(in_a_part.starts_with("4500 of the first 4500 of 9000 logs; the others cannot be unpacked ("))
      << in_a_part;
}

TEST(BatchIndexInChromium, ABrowserThatCannotUnpackShowsTheFirstRows) {
  NEEDS_CHROMIUM;
  std::string text = page_of(rows(1000));
  const std::string script(index_script());
  const std::string other = "window.DecompressionStream = undefined;\n" + script;
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace(source_hash(script), source_hash(other));
  replace("<script>" + script, "<script>" + other);
  const std::string shown = shown_by(text);
  EXPECT_TRUE(shown.starts_with("500 of the first 500 of 1000 logs; the others cannot be unpacked ("))
      << shown;
}

/// What the figures are, from the Web Content Accessibility Guidelines.
TEST(BatchIndexInChromium, EveryControlHasANameASizeAndContrast) {
  NEEDS_CHROMIUM;
  OpenIndex index(rows(60));
  for (const bool dark : {false, true}) {
    index.open_again(390, 6000, dark);
    index.show_trends();
    index.page.evaluate("document.getElementById('choice').open = true");
    const std::string bad = index.page.evaluate(R"((() => {
      const seen = [...document.querySelectorAll('button,input,select,summary,canvas')].filter(e => e.offsetParent);
      const named = e => e.getAttribute('aria-label') || e.textContent.trim() || (e.labels && e.labels.length);
      const small = e => e.type !== 'checkbox' && e.getBoundingClientRect().height < 23.5;
      return seen.filter(e => !named(e) || small(e)).map(e => e.outerHTML).join('\n');
    })())");
    EXPECT_EQ(bad, "");
    const double contrast = index.page.evaluate(R"((() => {
      const light = text => { const [r, g, b] = text.match(/\d+/g).map(v => v / 255).map(v => v <= 0.04045 ? v / 12.92 :
        ((v + 0.055) / 1.055) ** 2.4); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
      const ground = light(getComputedStyle(document.body).backgroundColor);
      return Math.min(...[...document.querySelectorAll('body *')].filter(e => e.offsetParent && e.childNodes.length &&
        [...e.childNodes].some(n => n.nodeType === 3 && n.data.trim())).map(e => { const ink =
        light(getComputedStyle(e).color); return (Math.max(ink, ground) + 0.05) / (Math.min(ink, ground) + 0.05); }));
    })())");
    EXPECT_GE(contrast, 4.5) << (dark ? "dark" : "light");
  }
}

TEST(BatchIndexInChromium, WithoutScriptThePageShowsItsTable) {
  NEEDS_CHROMIUM;
  OpenIndex index(rows(20), {.script = false});
  EXPECT_EQ(index.page.evaluate("document.querySelectorAll('.logs tbody tr').length"), 20);
  EXPECT_EQ(index.page.evaluate("document.querySelectorAll('figure svg').length"), 1);
  EXPECT_EQ(index.page.evaluate("getComputedStyle(document.querySelector('.tools')).display"), "none");
  OpenIndex many(rows(1000), {.script = false});
  EXPECT_EQ(many.page.evaluate("document.querySelectorAll('.logs tbody tr').length"), 500);
  EXPECT_EQ(many.page.evaluate("document.body.textContent.includes('The first 500 of 1000 logs')"), true);
}

}  // namespace
}  // namespace faultline
