// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>

#include "lib/batch/find_logs.hpp"
#include "lib/core/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

std::vector<int> chosen(const std::vector<std::string>& names, const std::vector<std::string>& folders) {
  std::vector<BatchLog> logs;
  for (const std::string& name : names) logs.push_back({"/nowhere/" + name, name, 0});
  std::vector<int> models;
  for (const BatchLog& log : with_models(logs, folders)) models.push_back(log.model);
  return models;
}

std::string refusal(const std::vector<std::string>& names, const std::vector<std::string>& folders) {
  try {
    chosen(names, folders);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    return error.what();
  }
  return "";
}

TEST(ChooseModels, PrefersTheModelOfTheFolderToThePlainModel) {
  EXPECT_EQ(chosen({"runs/line1/a.csv", "runs/line2/b.csv", "runs/line1/day/c.csv"}, {"", "line1"}),
            (std::vector<int>{1, 0, 1}));
  EXPECT_EQ(chosen({"runs/line1/a.csv"}, {"runs/line1/"}), std::vector<int>{0});
}

TEST(ChooseModels, AFolderMatchesOnlyCompleteFolderNamesOfALog) {
  EXPECT_EQ(chosen({"runs/line10/a.csv", "runs/line1/line1", "line1/x.csv"}, {"", "line1"}),
            (std::vector<int>{0, 1, 1}));
  EXPECT_EQ(chosen({"runs/b/line1", "line1/a.csv"}, {"", "line1"}), (std::vector<int>{0, 1}));
}

TEST(ChooseModels, TheDeepestFolderDecidesInAnyOrderOfTheModels) {
  const std::vector<std::string> names{"runs/line1/day2/a.csv"};
  EXPECT_EQ(chosen(names, {"line1", "day2"}), std::vector<int>{1});
  EXPECT_EQ(chosen(names, {"day2", "line1"}), std::vector<int>{0});
  EXPECT_EQ(chosen(names, {"day2", "line1/day2"}), std::vector<int>{1});
}

TEST(ChooseModels, AnExistingFolderIsMatchedByItsPath) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.file("plant/line1"));
  const std::vector<BatchLog> found{{folder.write("plant/line1/a.csv", "x"), "line1/a.csv", 0},
                                    {folder.write("plant/b.csv", "x"), "plant/b.csv", 0}};
  const std::vector<BatchLog> logs =
      with_models(found, {folder.file("plant"), folder.file("plant/../plant/line1")});
  EXPECT_EQ(logs[0].model, 1);
  EXPECT_EQ(logs[1].model, 0);
  std::filesystem::create_directories(folder.file("plant/empty"));
  EXPECT_NO_THROW(with_models(found, {"", folder.file("plant/empty")})) << "no logs today";
}

TEST(ChooseModels, LogsWithoutAModelUnknownFoldersAndDuplicatesAreRefused) {
  EXPECT_NE(refusal({"runs/line1/a.csv", "runs/line2/b.csv", "c.csv"}, {"line1"})
                .find("runs/line2/b.csv: 2 of 3 logs have no model"),
            std::string::npos);
  EXPECT_NE(refusal({"runs/line1/a.csv"}, {"", "lin1"}).find("no log is below a folder of that name"),
            std::string::npos);
  EXPECT_NE(refusal({"runs/line1/a.csv"}, {"line1", "./line1"}).find("is given twice for folder"),
            std::string::npos);
  EXPECT_NE(refusal({"runs/line1/a.csv"}, {"", ""}).find("twice without a folder"), std::string::npos);
}

}  // namespace
}  // namespace faultline
