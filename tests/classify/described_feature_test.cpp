// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/classify/episode_features.hpp"
#include "tests/diagnose/hand_made_episode.hpp"

namespace faultline {
namespace {

class DescribedFeatures : public testing::Test {
 protected:
  DescribedFeature read(const std::string& name) const {
    for (std::size_t i = 0; i < list_.size(); ++i)
      if (name_of(list_[i]) == name)
        return describe_feature(list_, i, features_, model_.motion, model_.robot.chain);
    ADD_FAILURE() << "no feature " << name;
    return {};
  }

  Model model_ = hand_made_rrp();
  std::vector<EpisodeFeature> list_ = episode_feature_list(model_.labels, 3);
  std::vector<double> features_ = [this] {
    MonitoredEpisode episode = episode_of_fault(kBias3, 100.0, 0.02);
    explain(episode, kLoss1, 88.0, 0.4);
    return seen(episode, model_, residuals_of({1.0, 2.0, 20.0})).features;
  }();
};

TEST_F(DescribedFeatures, EvidenceBehindTheBestLabelIsInNats) {
  EXPECT_NEAR(read("behind torque_loss 1").value, 12.0, 1e-9);
  EXPECT_EQ(read("behind sensor_bias 3").value, 0.0);
  EXPECT_EQ(read("behind torque_loss 1").unit, "nats");
  EXPECT_NE(read("behind torque_loss 1").what.find("joint 1 lost a part of its torque"), std::string::npos);
}

TEST_F(DescribedFeatures, SizesHaveTheirUnits) {
  EXPECT_NEAR(read("size sensor_bias 3").value, 0.02, 1e-9);
  EXPECT_EQ(read("size sensor_bias 3").unit, "m") << "joint 3 slides";
  EXPECT_NEAR(read("size torque_loss 1").value, 40.0, 1e-6);
  EXPECT_EQ(read("size torque_loss 1").unit, "%");
  EXPECT_TRUE(std::isnan(read("size sensor_bias 1").value)) << "too far behind to tell";
}

TEST_F(DescribedFeatures, StrengthDurationAndResidualsHaveTheirValues) {
  EXPECT_NEAR(read("strength").value, 100.0, 1e-9);
  EXPECT_NEAR(read("duration").value, 2.0, 1e-9);
  EXPECT_NEAR(read("mlp residual 3").value, 20.0, 1e-9);
  EXPECT_EQ(read("mlp residual 3").what, "MLP residual of joint 3");
}

}  // namespace
}  // namespace faultline
