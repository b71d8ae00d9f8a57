// SPDX-License-Identifier: MIT
// What a reader sees of the site that is built of docs/: lists and code as written, pictures, menu, search.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "lib/core/atomic_file.hpp"
#include "tests/support/chromium.hpp"
#include "tests/support/skip_unless_installed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

const fs::path kSiteDocs = fs::path(FAULTLINE_SOURCE_DIR) / "docs";

/// Lists and blocks of code of a page.
struct PageBlocks {
  int code = 0, numbered_lists = 0, list_items = 0;

  bool operator==(const PageBlocks&) const = default;
};

std::ostream& operator<<(std::ostream& out, const PageBlocks& blocks) {
  return out << blocks.code << " blocks of code, " << blocks.numbered_lists << " numbered lists, "
             << blocks.list_items << " items";
}

/// As the text in Markdown means them by the rules of CommonMark, as far as the pages use them.
PageBlocks blocks_written_in(const std::string& text) {
  static const std::regex item(R"(^ *(\d+\.|[-*]) +(?=\S))");
  PageBlocks blocks;
  std::istringstream all(text);
  std::size_t content = 0;  // column at which the content of the present list item begins
  bool fenced = false, can_begin_code = true, in_code = false;
  for (std::string line; std::getline(all, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin != std::string::npos && line.compare(begin, 3, "```") == 0) {
      fenced = !fenced;
      blocks.code += fenced;
      can_begin_code = true;
      continue;
    }
    if (fenced) continue;
    if (begin == std::string::npos) {
      can_begin_code = true;
      continue;
    }
    std::smatch match;
    const bool is_item = std::regex_search(line, match, item);
    if (begin == 0 && !is_item) content = 0;
    if (begin >= content + 4 && (can_begin_code || in_code)) {
      blocks.code += !in_code;
      in_code = true;
      continue;
    }
    in_code = false;
    can_begin_code = line[0] == '#';
    if (!is_item || begin >= content + 4) continue;
    content = static_cast<std::size_t>(match.length());
    ++blocks.list_items;
    blocks.numbered_lists += match[1] == "1.";
  }
  return blocks;
}

int occurrences(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// What stands in a page besides the menu and the list of its headings.
std::string page_content(const std::string& html) {
  const std::size_t main = html.find("<main>"), contents = html.find("class=\"contents\"", main);
  return html.substr(contents == std::string::npos ? main : html.find("</details>", contents));
}

PageBlocks blocks_shown_in(const std::string& html) {
  const std::string content = page_content(html);
  return {occurrences(content, "<pre"), occurrences(content, "<ol"), occurrences(content, "<li>")};
}

/// The site, built once for all tests of this file.
class DocumentationSitePages : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (std::system("PATH=/usr/bin:$PATH mkdocs --version >/dev/null 2>&1") != 0) return;
    folder_ = new TemporaryFolder;
    const std::string script = (kSiteDocs / "build_site.sh").string(), log = folder_->file("log.txt");
    built_ =
        std::system(("bash '" + script + "' '" + site().string() + "' >'" + log + "' 2>&1").c_str()) == 0;
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  void SetUp() override {
    SKIP_UNLESS_INSTALLED(folder_, "mkdocs is missing");
    ASSERT_TRUE(built_) << read_file(folder_->file("log.txt"));
  }

  static fs::path site() { return folder_->file("site"); }
  static fs::path page_of(const fs::path& markdown) {
    const fs::path name = fs::relative(markdown, kSiteDocs);
    return site() / (name.filename() == "README.md" ? name.parent_path() / "index.html"
                                                    : fs::path(name).replace_extension("html"));
  }

  static inline TemporaryFolder* folder_ = nullptr;
  static inline bool built_ = false;
};

#define SKIP_WITHOUT_BROWSER() SKIP_UNLESS_INSTALLED(!chromium_program().empty(), "Chromium is missing")

TEST(DocumentationBlocks, TheCountOfBlocksIncludesBlocksInLists) {
  EXPECT_EQ(blocks_written_in("# A\n    code\n\n1.  one\n\n        code\n\n    more\n2.  two\n\n- bullet\n"),
            (PageBlocks{2, 1, 3}));
  EXPECT_EQ(blocks_written_in("text\n    goes on\n\n```\n- no item\n```\n"), (PageBlocks{1, 0, 0}));
}

TEST_F(DocumentationSitePages, ShowEachCodeBlockAndListOfTheirSource) {
  for (const auto& entry : fs::recursive_directory_iterator(kSiteDocs)) {
    if (entry.path().extension() != ".md") continue;
    EXPECT_EQ(blocks_shown_in(read_file(page_of(entry.path()).string())),
              blocks_written_in(read_file(entry.path().string())))
        << entry.path();
  }
}

TEST_F(DocumentationSitePages, TheFirstPagesHavePicturesWithAlternativeText) {
  static const std::regex image(R"re(<img alt="([^"]*)" src="([^"]*)")re");
  for (const char* name : {"index.html", "quick-start.html", "tutorial/first-fault.html"}) {
    const fs::path page = site() / name;
    const std::string text = read_file(page.string());
    int pictures = 0;
    for (std::sregex_iterator it(text.begin(), text.end(), image), end; it != end; ++it, ++pictures) {
      EXPECT_GT((*it)[1].length(), 20) << name;
      EXPECT_TRUE(fs::exists(page.parent_path() / (*it)[2].str())) << name << ": " << (*it)[2];
    }
    EXPECT_GT(pictures, 0) << name;
  }
}

TEST_F(DocumentationSitePages, TheMenuOnAPhoneStaysSmallUntilItIsOpened) {
  SKIP_WITHOUT_BROWSER();
  BrowserPage page({.width = 390, .height = 844});
  page.open((site() / "quick-start.html").string());
  const std::string height = "document.querySelector('header').getBoundingClientRect().height";
  EXPECT_LT(page.evaluate(height).get<double>(), 100.0);
  EXPECT_EQ(page.evaluate("document.documentElement.scrollWidth"), 390);
  page.evaluate("document.querySelector('#menu').focus()");
  page.press(" ");
  EXPECT_GT(page.evaluate(height).get<double>(), 300.0);
  page.resize(1280, 800);
  EXPECT_EQ(page.evaluate("getComputedStyle(document.querySelector('nav')).display"), "block");
  EXPECT_TRUE(page.complaints().empty()) << page.complaints().front();
}

TEST_F(DocumentationSitePages, SearchFindsSectionsWhenTheSiteIsAFolderOfFiles) {
  SKIP_WITHOUT_BROWSER();
  BrowserPage page;
  page.open((site() / "how-to/columns.html").string());
  const std::string form = page.evaluate("new URL(document.querySelector('form').action).pathname");
  const std::string field = page.evaluate("document.querySelector('input[type=search]').name");
  page.open(form + "?" + field + "=payload+TIP");
  const nlohmann::json links =
      page.evaluate("[...document.querySelectorAll('#results a')].map(a => a.getAttribute('href'))");
  ASSERT_GT(links.size(), 1u);
  for (const nlohmann::json& link : links) {
    const std::string target = link.get<std::string>();
    EXPECT_TRUE(fs::exists(site() / target.substr(0, target.find('#')))) << target;
  }
  EXPECT_TRUE(page.complaints().empty()) << page.complaints().front();
}

TEST_F(DocumentationSitePages, SearchReportsZeroSectionsIfNoneHasAllWords) {
  SKIP_WITHOUT_BROWSER();
  BrowserPage page;
  page.open((site() / "search.html?q=%3Cb%3Exyzzy").string());
  EXPECT_EQ(page.evaluate("document.querySelector('#count').textContent"),
            "0 sections have all these words.");
  EXPECT_EQ(page.evaluate("document.querySelectorAll('main b').length"), 0);
}

}  // namespace
}  // namespace faultline
