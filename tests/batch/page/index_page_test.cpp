// SPDX-License-Identifier: MIT
#include "lib/batch/page/index_page.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace faultline {
namespace {

/// A log in a folder of its own, with this residual, or not usable if that is not a number.
BatchRow row_in(int folder, double residual) {
  BatchRow row;
  row.log = "runs/day_" + std::to_string(1000 + folder) + "/a.csv";
  row.verdict = "unusable";
  if (!(residual > 0.0)) return row;
  row.verdict = "healthy";
  row.residual_rms = {residual};
  return row;
}

/// Names of the folders in the table by folder.
std::string folders_of(const std::vector<BatchRow>& rows) {
  const std::string page = render_index_page(rows, summary_of(rows, {}), false);
  const std::size_t from = page.find("<h2>By folder</h2>");
  return page.substr(from, page.find("</table>", from) - from);
}

int count_of(const std::string& part, const std::string& text) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(FoldersOfAnIndex, AreAllThereUpToTwoHundred) {
  std::vector<BatchRow> rows;
  for (int i = 0; i < 200; ++i) rows.push_back(row_in(i, i % 2 ? 1.0 : std::nan("")));
  const std::string table = folders_of(rows);
  EXPECT_EQ(count_of("runs/day_", table), 200);
  EXPECT_EQ(table.find("largest residuals"), std::string::npos);
}

TEST(FoldersOfAnIndex, OfMoreThoseWithTheLargestResidualsAreThere) {
  std::vector<BatchRow> rows;
  for (int i = 0; i < 300; ++i) rows.push_back(row_in(i, i < 50 ? std::nan("") : 1.0 + i));
  const std::string table = folders_of(rows);
  EXPECT_EQ(count_of("runs/day_", table), 200);
  EXPECT_NE(table.find("The 200 of 300 folders"), std::string::npos);
  EXPECT_EQ(table.find("day_1099"), std::string::npos);
  EXPECT_NE(table.find("day_1100"), std::string::npos);
}

TEST(FoldersOfAnIndex, WithoutAnyJudgedLogAreThereToo) {
  std::vector<BatchRow> rows;
  for (int i = 0; i < 300; ++i) rows.push_back(row_in(i, std::nan("")));
  EXPECT_EQ(count_of("runs/day_", folders_of(rows)), 200);
}

}  // namespace
}  // namespace faultline
