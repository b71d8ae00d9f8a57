// SPDX-License-Identifier: MIT
#include "lib/fault/fault_kind.hpp"

#include <gtest/gtest.h>

namespace faultline {
namespace {

TEST(LabelText, NamesTheJointOnlyWhenThereIsOne) {
  EXPECT_EQ(label_text({FaultKind::torque_loss, 2_joint}), "torque_loss 2");
  EXPECT_EQ(label_text({FaultKind::torque_loss, 2_joint}, " at joint "), "torque_loss at joint 2");
  EXPECT_EQ(label_text({FaultKind::unknown, Joint()}, " at joint "), "unknown");
}

}  // namespace
}  // namespace faultline
