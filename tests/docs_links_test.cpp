// SPDX-License-Identifier: MIT
// Links of every page in Markdown: files, folders and anchors; and the site that is built of docs/.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "lib/core/atomic_file.hpp"
#include "tests/support/skip_unless_installed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot(FAULTLINE_SOURCE_DIR);

std::vector<fs::path> pages() {
  std::vector<fs::path> found = {kRoot / "README.md", kRoot / "sample_logs/README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs"))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
}

/// The lines that are prose: code, fenced or indented behind a blank line, is left out.
std::vector<std::string> prose_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream all(text);
  bool fenced = false, after_blank = true, indented = false;
  for (std::string line; std::getline(all, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    const bool fence = begin != std::string::npos && line.compare(begin, 3, "```") == 0;
    indented = line.rfind("    ", 0) == 0 && (after_blank || indented);
    if (!fence && !fenced && !indented) lines.push_back(line);
    fenced ^= fence;
    after_blank = begin == std::string::npos;
  }
  return lines;
}

/// As code hosts make it of a heading; `joined` as MkDocs does, where dashes in a row are one.
std::string anchor_of(std::string heading, bool joined) {
  static const std::regex link(R"(\[([^\]]*)\]\([^)]*\))");
  heading = std::regex_replace(heading, link, "$1");
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) || c == '_') anchor += static_cast<char>(std::tolower(byte));
    if ((c == ' ' || c == '-') && !(joined && anchor.ends_with('-'))) anchor += '-';
  }
  return anchor;
}

/// Anchors that lead to a heading on a code host as well as on the site.
std::set<std::string> anchors_of(const fs::path& page) {
  static const std::regex heading(R"(^#+ +(.*?) *$)");
  std::set<std::string> anchors;
  for (const std::string& line : prose_of(read_file(page.string()))) {
    std::smatch match;
    if (!std::regex_match(line, match, heading)) continue;
    const std::string anchor = anchor_of(match[1], false);
    if (anchor == anchor_of(match[1], true)) anchors.insert(anchor);
  }
  return anchors;
}

struct PageLink {
  std::string text;  ///< as written
  fs::path target;
  std::string anchor;  ///< empty for none
};

/// Files, folders and anchors that a page links to, without those on the web.
std::vector<PageLink> links_of(const fs::path& page) {
  static const std::regex pattern(R"(\]\(([^)#\s]*)(#[^)\s]*)?\))"), code("`[^`]*`");
  std::string text;
  for (const std::string& line : prose_of(read_file(page.string()))) text += line + "\n";
  text = std::regex_replace(text, code, "code");
  std::vector<PageLink> links;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
    const std::string path = (*it)[1].str(), anchor = (*it)[2].matched ? (*it)[2].str().substr(1) : "";
    if (path.find("://") != std::string::npos || (path.empty() && anchor.empty())) continue;
    links.push_back(
        {(*it)[0].str(), path.empty() ? page : (page.parent_path() / path).lexically_normal(), anchor});
  }
  return links;
}

TEST(DocumentationLinks, EveryLinkPointsToAnExistingFile) {
  int checked = 0;
  for (const fs::path& page : pages())
    for (const PageLink& link : links_of(page)) {
      EXPECT_TRUE(fs::exists(link.target)) << page << " links to " << link.target;
      ++checked;
    }
  EXPECT_GT(checked, 100);
}

TEST(DocumentationLinks, EveryAnchorIsAHeadingOfItsPage) {
  int checked = 0;
  for (const fs::path& page : pages())
    for (const PageLink& link : links_of(page)) {
      if (link.anchor.empty() || !fs::exists(link.target)) continue;
      EXPECT_TRUE(anchors_of(link.target).contains(link.anchor)) << page << " links to " << link.text;
      ++checked;
    }
  EXPECT_GT(checked, 10);
}

/// Pages that the program writes.
bool is_generated(const fs::path& page) {
  return page == kRoot / "docs/paper.md" || page.parent_path() == kRoot / "docs/reference/commands";
}

/// Number of characters of a text in UTF-8.
std::ptrdiff_t characters(const std::string& text) {
  return std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; });
}

/// Lines of prose of more than 125 characters; rows of tables, pictures, links and HTML cannot be broken.
std::vector<std::string> long_lines_of(const fs::path& page) {
  constexpr std::ptrdiff_t kLongest = 125;
  std::vector<std::string> found;
  for (const std::string& line : prose_of(read_file(page.string()))) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin == std::string::npos || std::string("|<[!").find(line[begin]) != std::string::npos) continue;
    if (characters(line) > kLongest) found.push_back(line);
  }
  return found;
}

TEST(DocumentationLinks, LinesOfProseAreShort) {
  for (const fs::path& page : pages()) {
    if (is_generated(page)) continue;
    for (const std::string& line : long_lines_of(page)) ADD_FAILURE() << page << ": " << line;
  }
}

TEST(DocumentationLinks, TheCheckFindsALongLineOfProse) {
  const TemporaryFolder folder;
  const std::string words(126, 'x'), umlauts = "\u00e4";
  std::string wide;
  for (int i = 0; i < 125; ++i) wide += umlauts;
  const fs::path page =
      folder.write("page.md", words + "\n\n| " + words + " |\n\n    " + words + "\n\n" + wide + "\n");
  EXPECT_EQ(long_lines_of(page), std::vector<std::string>{words});
}

TEST(DocumentationLinks, TheCheckFindsABrokenAnchor) {
  const TemporaryFolder folder;
  const fs::path page = folder.write("page.md",
                                     "# What it is, `here` (a.hpp)\n\n[a](#what) [b](other.md#x)\n\n"
                                     "    [c](code)\n");
  EXPECT_EQ(anchors_of(page), std::set<std::string>{"what-it-is-here-ahpp"});
  ASSERT_EQ(links_of(page).size(), 2u);
  EXPECT_EQ(links_of(page)[0].target, page);
  EXPECT_FALSE(anchors_of(page).contains(links_of(page)[0].anchor));
  EXPECT_FALSE(fs::exists(links_of(page)[1].target));
}

/// On the site nothing outside of docs/ can be reached.
TEST(DocumentationLinks, PagesOfTheSiteLinkOnlyToPagesOfTheSite) {
  for (const fs::path& page : pages()) {
    if (page == kRoot / "README.md" || page == kRoot / "sample_logs/README.md") continue;
    for (const PageLink& link : links_of(page))
      EXPECT_EQ(link.target.string().rfind((kRoot / "docs/").string(), 0), 0u) << page << ": " << link.text;
  }
}

/// What a page loads by itself; links (`<a href>`) load nothing.
void expect_loads_only_what_is_there(const fs::path& page) {
  static const std::regex loaded(R"(<(?:img|script|link|iframe|source)\b[^>]*?\b(?:src|href)="([^"#?]*))");
  const std::string text = read_file(page.string());
  for (std::sregex_iterator it(text.begin(), text.end(), loaded), end; it != end; ++it) {
    const std::string target = (*it)[1].str();
    if (target.empty() || target.rfind("data:", 0) == 0) continue;
    EXPECT_EQ(target.find("//"), std::string::npos) << page << " loads " << target;
    EXPECT_TRUE(fs::exists((page.parent_path() / target).lexically_normal())) << page << " loads " << target;
  }
}

void expect_links_lead_somewhere(const fs::path& page) {
  static const std::regex linked(R"re(<a\b[^>]*?\bhref="([^"#?]*)(?:#([^"]*))?")re");
  const std::string text = read_file(page.string());
  for (std::sregex_iterator it(text.begin(), text.end(), linked), end; it != end; ++it) {
    const std::string target = (*it)[1].str(), anchor = (*it)[2].str();
    if (target.find("//") != std::string::npos || target.rfind("mailto:", 0) == 0) continue;
    const fs::path file = target.empty() ? page : (page.parent_path() / target).lexically_normal();
    ASSERT_TRUE(fs::exists(file)) << page << " links to " << target;
    if (anchor.empty() || file.extension() != ".html") continue;
    EXPECT_NE(read_file(file.string()).find("id=\"" + anchor + "\""), std::string::npos)
        << page << " links to " << target << "#" << anchor;
  }
}

void expect_styles_load_nothing(const fs::path& style) {
  static const std::regex elsewhere(R"re((url\(["']?|@import +["'])(https?:)?//)re");
  EXPECT_FALSE(std::regex_search(read_file(style.string()), elsewhere)) << style;
}

TEST(DocumentationSite, OneCommandBuildsASiteThatLoadsNothingFromOtherHosts) {
  SKIP_UNLESS_INSTALLED(std::system("PATH=/usr/bin:$PATH mkdocs --version >/dev/null 2>&1") == 0,
                        "mkdocs is missing");
  const TemporaryFolder folder;
  const std::string site = folder.file("site"), log = folder.file("log.txt");
  const std::string script = (kRoot / "docs/build_site.sh").string();
  ASSERT_EQ(std::system(("bash '" + script + "' '" + site + "' >'" + log + "' 2>&1").c_str()), 0)
      << read_file(log);
  int built = 0;
  for (const auto& entry : fs::recursive_directory_iterator(site)) {
    if (entry.path().extension() == ".css") expect_styles_load_nothing(entry.path());
    if (entry.path().extension() != ".html") continue;
    ++built;
    expect_loads_only_what_is_there(entry.path());
    if (entry.path().filename() != "404.html") expect_links_lead_somewhere(entry.path());
  }
  EXPECT_GE(built, static_cast<int>(pages().size()) - 2);
}

TEST(DocumentationSite, TheNavigationListsEveryPage) {
  const std::string navigation = read_file((kRoot / "docs/site/mkdocs.yml").string());
  for (const fs::path& page : pages()) {
    const std::string name = fs::relative(page, kRoot / "docs").string();
    if (name.rfind("..", 0) == 0 || name.rfind("decisions/0", 0) == 0) continue;
    EXPECT_NE(navigation.find(": " + name + "\n"), std::string::npos) << name;
  }
  const std::string decisions = read_file((kRoot / "docs/decisions/README.md").string());
  for (const auto& entry : fs::directory_iterator(kRoot / "docs/decisions")) {
    const std::string name = entry.path().filename().string();
    if (name == "README.md") continue;
    EXPECT_NE(decisions.find("](" + name + ")"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace faultline
