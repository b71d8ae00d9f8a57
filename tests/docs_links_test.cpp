// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "lib/core/atomic_file.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> pages() {
  const fs::path root(FAULTLINE_SOURCE_DIR);
  std::vector<fs::path> found = {root / "README.md", root / "sample_logs/README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
}

/// Files and folders a page links to, without those on the web.
std::vector<fs::path> links_of(const fs::path& page) {
  static const std::regex pattern(R"(\]\(([^)#\s]+)(#[^)]*)?\))");
  const std::string text = read_file(page.string());
  std::vector<fs::path> links;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    if ((*it)[1].str().find("://") == std::string::npos)
      links.push_back((page.parent_path() / (*it)[1].str()).lexically_normal());
  return links;
}

TEST(Docs, EveryLinkLeadsSomewhere) {
  int checked = 0;
  for (const fs::path& page : pages())
    for (const fs::path& link : links_of(page)) {
      EXPECT_TRUE(fs::exists(link)) << page << " links to " << link;
      ++checked;
    }
  EXPECT_GT(checked, 15);
}

}  // namespace
}  // namespace faultline
