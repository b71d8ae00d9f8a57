// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> layers() {
  const std::string text = text_of(fs::path(FAULTLINE_SOURCE_DIR) / "lib/CMakeLists.txt");
  const auto begin = text.find("FAULTLINE_LAYERS") + std::string("FAULTLINE_LAYERS").size();
  std::istringstream words(text.substr(begin, text.find(')', begin) - begin));
  std::vector<std::string> names;
  for (std::string word; words >> word;) names.push_back(word);
  return names;
}

std::vector<std::string> project_includes(const fs::path& source) {
  static const std::regex pattern("#include \"([^\"]+)\"");
  const std::string text = text_of(source);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    found.push_back((*it)[1]);
  return found;
}

bool is_source(const fs::path& path) { return path.extension() == ".cpp" || path.extension() == ".hpp"; }

TEST(Layering, EveryFolderOfLibIsInTheOrderedList) {
  const auto names = layers();
  for (const auto& entry : fs::directory_iterator(fs::path(FAULTLINE_SOURCE_DIR) / "lib")) {
    if (!entry.is_directory()) continue;
    EXPECT_NE(std::find(names.begin(), names.end(), entry.path().filename()), names.end()) << entry.path();
  }
}

TEST(Layering, ALayerIncludesOnlyItselfAndLayersBelow) {
  const auto names = layers();
  ASSERT_GE(names.size(), 10u);
  const fs::path root(FAULTLINE_SOURCE_DIR);
  int checked = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!fs::is_directory(root / "lib" / names[i])) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / "lib" / names[i])) {
      if (!is_source(entry.path())) continue;
      for (const std::string& include : project_includes(entry.path())) {
        ASSERT_EQ(include.rfind("lib/", 0), 0u) << entry.path() << " includes " << include;
        const std::string layer = include.substr(4, include.find('/', 4) - 4);
        const auto found = std::find(names.begin(), names.end(), layer);
        EXPECT_TRUE(found != names.end() && static_cast<std::size_t>(found - names.begin()) <= i)
            << entry.path() << " includes " << include << ", which is not below it";
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 10);
}

TEST(Layering, FormatsKnowOnlyLogAndCore) {
  const fs::path root(FAULTLINE_SOURCE_DIR);
  for (const auto& entry : fs::recursive_directory_iterator(root / "formats")) {
    if (!is_source(entry.path())) continue;
    for (const std::string& include : project_includes(entry.path()))
      EXPECT_TRUE(include.rfind("formats/", 0) == 0 || include.rfind("lib/log/", 0) == 0 ||
                  include.rfind("lib/core/", 0) == 0)
          << entry.path() << " includes " << include;
  }
}

}  // namespace
