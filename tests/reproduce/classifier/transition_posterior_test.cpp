// SPDX-License-Identifier: MIT
#include "lib/reproduce/classifier/transition_posterior.hpp"

#include <gtest/gtest.h>

namespace faultline {
namespace {

class TransitionPosterior : public testing::TestWithParam<ControllerVariant> {
 protected:
  FaultPatterns patterns(int count, double sigma, SeedUse use) const {
    return fault_patterns(experiment, {.count = count, .sigma = sigma, .torque_phi = 0.5}, use);
  }
  TransitionModel learned() const {
    return learn_transition_model(SampleModel(experiment.robot, GetParam(), TorqueBetween::controlled),
                                  patterns(90, 0.0, SeedUse::classifier_training));
  }
  const Experiment experiment = experiment_on(bench_robot(), GetParam(), 2);
};

TEST(SampleModel, PredictsEachClassUnderHeldAndPd) {
  const Robot robot = bench_robot();
  for (const ControllerVariant controller : {ControllerVariant::held, ControllerVariant::pd}) {
    const Experiment experiment = experiment_on(robot, controller, 2);
    const SampleModel model(robot, controller, TorqueBetween::controlled);
    const FaultPatterns test = fault_patterns(experiment, {.count = 9}, SeedUse::classifier_test);
    for (int output = 0; output < kFaultClasses; ++output) {
      const Transitions& t = test.of_class[output];
      for (int i = 0; i < t.count(); ++i) {
        const JointState end = model.next({t.q.col(i), t.dq.col(i)}, t.tau.col(i), t.tau.col(i), output);
        EXPECT_LT((end.dq - t.next_dq.col(i)).cwiseQuotient(experiment.ranges.dq).norm(), 0.01)
            << output << ' ' << i;
      }
    }
  }
}

TEST_P(TransitionPosterior, IsADistributionThatFavoursTheTruth) {
  const TransitionModel model = learned();
  const FaultPatterns test = patterns(18, 0.01, SeedUse::classifier_test);
  const Eigen::MatrixXd posterior = transition_posterior(model, test.of_class[2], experiment.ranges, 0.01);
  EXPECT_LT((posterior.colwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
  EXPECT_GT(posterior.row(2).mean(), 0.95);
}

TEST_P(TransitionPosterior, ErrorGrowsWithTheNoiseAndStaysBelowThatOfThePrior) {
  const TransitionModel model = learned();
  const Eigen::Vector4d prior = table_1_prior();
  const double knows_nothing = (1.0 - prior.squaredNorm()) / kFaultClasses;
  double errors[3];
  for (int noise = 0; noise < 3; ++noise)
    errors[noise] = posterior_error(model, patterns(36, kNoiseVariants[noise], SeedUse::classifier_test),
                                    experiment.ranges, kNoiseVariants[noise]);
  EXPECT_LT(errors[0], errors[2]);
  EXPECT_LT(errors[1], errors[2]);
  EXPECT_LT(errors[2], 0.5 * knows_nothing);
}

INSTANTIATE_TEST_SUITE_P(Controllers, TransitionPosterior, testing::ValuesIn(kControllerVariants),
                         [](const auto& controller) { return std::string(to_string(controller.param)); });

}  // namespace
}  // namespace faultline
