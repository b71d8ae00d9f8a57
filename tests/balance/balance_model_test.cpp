// SPDX-License-Identifier: MIT
#include "lib/balance/balance_model.hpp"

#include <gtest/gtest.h>

namespace faultline {
namespace {

TEST(BalanceModel, ExcessOfViscousFrictionKeepsTheFrictionAtHalfTheTopSpeed) {
  constexpr double kViscous = 2.0, kDry = 3.0, kTopSpeed = 4.0, kExcess = 0.3;
  const double part = viscous_part(kViscous, kDry, kTopSpeed);
  const double viscous = kViscous * (1.0 + (1.0 - part) * kExcess), dry = kDry * (1.0 - part * kExcess);
  EXPECT_NEAR(viscous * 0.5 * kTopSpeed + dry, kViscous * 0.5 * kTopSpeed + kDry, 1e-12);
  EXPECT_NEAR(viscous / kViscous - dry / kDry, kExcess, 1e-12);
}

TEST(BalanceModel, ViscousPartIsZeroWithoutViscousFrictionAndOneWithoutDryFriction) {
  EXPECT_EQ(viscous_part(0.0, 3.0, 4.0), 0.0);
  EXPECT_EQ(viscous_part(-0.1, 3.0, 4.0), 0.0);
  EXPECT_EQ(viscous_part(2.0, 0.0, 4.0), 1.0);
  EXPECT_EQ(viscous_part(0.0, 0.0, 0.0), 0.0);
}

}  // namespace
}  // namespace faultline
