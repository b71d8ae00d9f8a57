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

/// The words of set(LIST ...) in lib/CMakeLists.txt.
std::vector<std::string> ordered_list(const std::string& list) {
  const std::string text = text_of(fs::path(FAULTLINE_SOURCE_DIR) / "lib/CMakeLists.txt");
  const std::string head = "set(" + list;
  const auto found = text.find(head);
  if (found == std::string::npos) return {};
  const auto begin = found + head.size();
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

void expect_folders_listed(const std::string& folder, const std::vector<std::string>& names) {
  for (const auto& entry : fs::directory_iterator(fs::path(FAULTLINE_SOURCE_DIR) / folder)) {
    if (!entry.is_directory()) continue;
    EXPECT_NE(std::find(names.begin(), names.end(), entry.path().filename()), names.end()) << entry.path();
  }
}

/// Whether `include`, seen from the folder `names[at]` of `folder`, lies in that one or in one before it.
bool is_below(const std::string& include, const std::string& folder, const std::vector<std::string>& names,
              std::size_t at) {
  const auto begin = folder.size() + 1;
  const std::string name = include.substr(begin, include.find('/', begin) - begin);
  const auto found = std::find(names.begin(), names.end(), name);
  return found != names.end() && static_cast<std::size_t>(found - names.begin()) <= at;
}

/// Holds each of the `names` in `folder` to itself and those before it. Returns how many includes were
/// checked.
int expect_order(const std::string& folder, const std::vector<std::string>& names) {
  const fs::path root = fs::path(FAULTLINE_SOURCE_DIR) / folder;
  int checked = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!fs::is_directory(root / names[i])) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / names[i])) {
      if (!is_source(entry.path())) continue;
      for (const std::string& include : project_includes(entry.path())) {
        if (include.rfind(folder + "/", 0) != 0) continue;
        EXPECT_TRUE(is_below(include, folder, names, i))
            << entry.path() << " includes " << include << ", which is not below it";
        ++checked;
      }
    }
  }
  return checked;
}

TEST(Layering, EveryFolderOfLibIsInTheOrderedList) {
  expect_folders_listed("lib", ordered_list("FAULTLINE_LAYERS"));
}

TEST(Layering, ALayerIncludesOnlyItselfAndLayersBelow) {
  const auto names = ordered_list("FAULTLINE_LAYERS");
  ASSERT_GE(names.size(), 10u);
  EXPECT_GT(expect_order("lib", names), 10);
}

TEST(Layering, LibIncludesNothingOutsideOfIt) {
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(FAULTLINE_SOURCE_DIR) / "lib")) {
    if (!is_source(entry.path())) continue;
    for (const std::string& include : project_includes(entry.path()))
      EXPECT_EQ(include.rfind("lib/", 0), 0u) << entry.path() << " includes " << include;
  }
}

TEST(Layering, EveryFolderOfReproduceIsInTheOrderedList) {
  expect_folders_listed("lib/reproduce", ordered_list("FAULTLINE_STUDIES"));
}

TEST(Layering, AStudyIncludesOnlyItselfAndStudiesBelow) {
  const auto names = ordered_list("FAULTLINE_STUDIES");
  ASSERT_GE(names.size(), 3u);
  EXPECT_GT(expect_order("lib/reproduce", names), 10);
}

TEST(Layering, FormatsIncludeOnlyFormatsLogAndCore) {
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
