// SPDX-License-Identifier: MIT
#include "lib/batch/find_logs.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "lib/core/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names(const std::vector<BatchLog>& logs) {
  std::vector<std::string> list;
  for (const BatchLog& log : logs) list.push_back(log.name);
  return list;
}

class FindLogs : public testing::Test {
 protected:
  void add(const std::string& name, const std::string& text = "t,q1\n0,1\n") {
    fs::create_directories((folder_.path() / name).parent_path());
    folder_.write(name, text);
  }
  std::vector<std::string> found(const std::vector<std::string>& given) {
    std::vector<std::string> paths;
    for (const std::string& path : given) paths.push_back(folder_.file(path));
    return names(find_logs(paths, {".csv", ".flog", ".csv.gz"}));
  }
  TemporaryFolder folder_;
};

TEST_F(FindLogs, FoldersAreSearchedAndSortedByName) {
  add("runs/b.csv");
  add("runs/a/z.flog");
  add("runs/a/B.CSV");
  add("runs/readme.md");
  add("runs/c.csv.gz");
  add("runs/other.gz");
  EXPECT_EQ(found({"runs"}),
            (std::vector<std::string>{"runs/a/B.CSV", "runs/a/z.flog", "runs/b.csv", "runs/c.csv.gz"}));
  EXPECT_EQ(found({"runs/"}), found({"runs"}));
  EXPECT_EQ(found({"runs/a/../a"}), (std::vector<std::string>{"a/B.CSV", "a/z.flog"}));
}

TEST_F(FindLogs, LabelsReportsHiddenFilesAndResultsAreNotLogs) {
  add("runs/good.csv");
  add("runs/labels.csv", "file,fault,joint,onset_s\n");
  add("runs/truth.csv", "file,fault,joint,onset_s\n");
  add("runs/.hidden.csv");
  add("runs/.git/x.csv");
  add("runs/out/.batch/lock");
  add("runs/out/index.csv");
  add("runs/out/other.csv");
  EXPECT_EQ(found({"runs"}), std::vector<std::string>{"runs/good.csv"});
}

TEST_F(FindLogs, AFileFoundTwiceIsOneLogAndANamedFileIsAlwaysALog) {
  add("runs/a.csv");
  add("notes");
  EXPECT_EQ(found({"runs", "runs/a.csv", "runs/../runs"}).size(), 1u);
  EXPECT_EQ(found({"runs", "runs/a.csv"}), found({"runs/a.csv", "runs"}));
  EXPECT_EQ(found({"notes"}), std::vector<std::string>{"notes"});
}

TEST_F(FindLogs, EqualNamesInTwoFoldersAreTwoLogs) {
  add("x/runs/a.csv");
  add("y/runs/a.csv");
  EXPECT_EQ(found({"x/runs", "y/runs"}), (std::vector<std::string>{"runs/a.csv", "runs/a.csv"}));
}

TEST_F(FindLogs, AMissingPathIsAnErrorAndALinkToItsOwnFolderMakesNoLoop) {
  EXPECT_THROW(found({"nothing"}), Error);
  add("runs/a.csv");
  fs::create_directory_symlink(folder_.path() / "runs", folder_.path() / "runs/again");
  EXPECT_EQ(found({"runs"}), std::vector<std::string>{"runs/a.csv"});
}

}  // namespace
}  // namespace faultline
