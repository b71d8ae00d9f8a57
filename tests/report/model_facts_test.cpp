// SPDX-License-Identifier: MIT
#include "lib/report/model_facts.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace faultline {
namespace {

TEST(ModelFacts, AParameterOfBothListsIsListedOnce) {
  Identification identification;
  identification.physical_parameters.resize(2);
  identification.physical_parameters[0].name = "m1";
  identification.physical_parameters[1].name = "l1";
  identification.base_parameters.resize(2);
  identification.base_parameters[0].name = "b1";
  identification.base_parameters[1].name = "l1";
  const auto listed = listed_parameters(identification);
  ASSERT_EQ(listed.size(), 3u);
  EXPECT_EQ(listed[1], &identification.physical_parameters[1]);
  EXPECT_EQ(listed[2]->name, "b1");
  EXPECT_EQ(parameter_table(identification).rows.size(), 3u);
}

TEST(ModelFacts, AKindThatWasNeverFoundHasNoDelay) {
  Validation validation;
  validation.rows = {{.kind = FaultKind::locked, .runs = 4, .detected = 0}};
  const FactTable table = validation_table(validation);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"locked", "4", "0", "0", "0", "0", "-"}));
  EXPECT_EQ(table.rows[0].size(), table.head.size());
  EXPECT_EQ(table.rows[1].size(), table.head.size());
}

TEST(ModelFacts, AMeasureIsANumberWithItsUnitOrADash) {
  EXPECT_EQ(fact_text(0.001, "s"), "0.001 s");
  EXPECT_EQ(fact_text(1.234567), "1.2346");
  EXPECT_EQ(fact_text(std::numeric_limits<double>::infinity(), "s"), "-");
}

}  // namespace
}  // namespace faultline
