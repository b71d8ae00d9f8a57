// SPDX-License-Identifier: MIT
#include "formats/diadem/diadem_table.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

TEST(DiademTables, AColumnLiesWhereTheHeaderStatesIt) {
  const TemporaryFolder folder;
  folder.write("a.r32", std::string(40, '\0'));
  DiademHeader made;
  DiademChannel stored;
  stored.name = "q1";
  stored.file = "a.r32";
  stored.type = DiademType::real32;
  stored.values = 5;
  stored.first = 4;
  made.channels = {stored};
  const DiademTable table = diadem_table(made, folder.file("a.dat"));
  ASSERT_EQ(table.places.size(), 1u);
  EXPECT_EQ(table.places[0].begin, 12);
  EXPECT_EQ(table.places[0].stride, 4);
  EXPECT_EQ(table.rows_held, 5);
}

}  // namespace
}  // namespace faultline
