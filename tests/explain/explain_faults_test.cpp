// SPDX-License-Identifier: MIT
// Several faults in one log, and faults that end, of a robot in closed form.
#include "lib/explain/explain_faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::changed;
using testing::ClosedFormRun;
using testing::ClosedFormScara;
using testing::fit_of;
using testing::of_day;
using testing::on_grid;
using testing::run_of;
using testing::scara_model;
using testing::simulate_closed_form;
using testing::with_loss;
using testing::with_loss_but_for_a_second;

std::vector<ExplainedFault> faults_of(Log log) {
  return explain_faults(on_grid(std::move(log)), scara_model(), evidence_limits({})).faults;
}

std::string said(const std::vector<ExplainedFault>& faults) {
  std::string out;
  for (const ExplainedFault& f : faults)
    out += label_text(f.claim.label()) + " from " + std::to_string(f.claim.onset_s) + " to " +
           std::to_string(f.claim.end_s) + ": " + std::to_string(f.evidence) + "; ";
  return out;
}

TEST(ExplainFaults, AHealthyLogHasNoFault) {
  EXPECT_TRUE(faults_of(simulate_closed_form(of_day(2), run_of(21))).empty());
}

TEST(ExplainFaults, ADayOfMoreViscousAndLessDryFrictionIsHealthy) {
  ClosedFormScara warm = of_day(0);
  for (int j = 0; j < 3; ++j) warm.fv[j] *= 1.2, warm.fc[j] *= 0.85;
  for (const std::uint64_t seed : {21, 22, 23})
    EXPECT_TRUE(faults_of(simulate_closed_form(warm, run_of(seed))).empty()) << seed;
}

TEST(ExplainFaults, ADayOfMoreFrictionInOneDirectionIsHealthy) {
  for (const std::uint64_t seed : {21, 22}) {
    const Log log =
        changed(simulate_closed_form(of_day(0), run_of(seed)), 0.0, kNeverEnds, [](Log& l, int k) {
          const ClosedFormScara robot;
          for (int j = 0; j < 3; ++j)
            l.tau[j][k] += 0.3 * robot.fc[j] * std::pow(std::tanh(l.dq[j][k] / robot.width), 2);
        });
    const auto faults = faults_of(log);
    EXPECT_TRUE(faults.empty()) << seed << ": " << said(faults);
  }
}

TEST(ExplainFaults, AnAxisThatLiftsItsOwnWeightHasNoTorqueGainOfTheDay) {
  const ExplainedLog log = explain_faults(on_grid(simulate_closed_form(of_day(2), run_of(21))), scara_model(),
                                          evidence_limits({}));
  const auto listed = [&](DayEffectKind kind, Joint joint) {
    return std::ranges::count_if(log.day,
                                 [&](const DayEffect& e) { return e.kind == kind && e.joint == joint; });
  };
  EXPECT_EQ(listed(DayEffectKind::torque_gain, 2_joint), 1);
  EXPECT_EQ(listed(DayEffectKind::friction, 3_joint), 1);
  EXPECT_EQ(listed(DayEffectKind::torque_gain, 3_joint), 0);
}

TEST(ExplainFaults, AFaultThatEndsHasItsEnd) {
  const auto faults =
      faults_of(with_loss(simulate_closed_form(of_day(0), run_of(22)), 2_joint, 0.4, 2.5, 5.5));
  ASSERT_EQ(faults.size(), 1u) << said(faults);
  EXPECT_EQ(faults[0].label(), (FaultLabel{FaultKind::torque_loss, 2_joint}));
  EXPECT_NEAR(faults[0].claim.onset_s, 2.5, 0.05);
  EXPECT_NEAR(faults[0].claim.end_s, 5.5, 0.05);
  EXPECT_NEAR(faults[0].claim.size[0], 0.4, 0.04);
}

/// Whether both losses of 40 and 30 % that begin at 4 s are named, with onset and size.
bool names_both(const std::vector<ExplainedFault>& faults) {
  return faults.size() == 2 && std::ranges::all_of(faults, [](const ExplainedFault& fault) {
           return fault.claim.kind == FaultKind::torque_loss && std::abs(fault.claim.onset_s - 4.0) < 0.05 &&
                  std::abs(fault.claim.size[0] - (fault.claim.joint == 2_joint ? 0.4 : 0.3)) < 0.04;
         });
}

// In the other motions one of them explains most of both; why is not known.
TEST(ExplainFaults, TwoSimultaneousFaultsAreBothFoundInSomeMotions) {
  constexpr int kSome = 3;
  int both = 0;
  for (std::uint64_t seed = 23; seed < 31 && both < kSome; ++seed) {
    const Log one = with_loss(simulate_closed_form(of_day(0), run_of(seed)), 2_joint, 0.4, 4.0);
    both += names_both(faults_of(with_loss(one, 1_joint, 0.3, 4.0)));
  }
  EXPECT_EQ(both, kSome);
}

TEST(ExplainFaults, ASecondFaultIsFoundAfterAFirst) {
  Log log = with_loss(simulate_closed_form(of_day(0), run_of(24)), 1_joint, 0.3, 2.5);
  log = changed(std::move(log), 5.0, kNeverEnds, [](Log& l, int k) { l.q[1][k] += 0.05; });
  const auto faults = faults_of(std::move(log));
  ASSERT_EQ(faults.size(), 2u) << said(faults);
  EXPECT_EQ(faults[0].label(), (FaultLabel{FaultKind::torque_loss, 1_joint}));
  EXPECT_EQ(faults[1].label(), (FaultLabel{FaultKind::sensor_bias, 2_joint}));
  EXPECT_NEAR(faults[1].claim.onset_s, 5.0, 0.02);
}

TEST(ExplainFaults, ATorqueLossThatOccursTwiceIsTwoFaults) {
  constexpr double kLasts_s = 1.5;
  for (const std::uint64_t seed : {25, 26, 27, 28}) {
    ClosedFormRun run = run_of(seed);
    run.duration_s = 10.0;
    Log log = simulate_closed_form(of_day(0), run);
    for (const double onset_s : {2.2, 6.1})
      log = with_loss(std::move(log), 1_joint, 0.6, onset_s, onset_s + kLasts_s);
    const auto faults = faults_of(std::move(log));
    ASSERT_EQ(faults.size(), 2u) << said(faults);
    for (const double onset_s : {2.2, 6.1}) {
      const FaultClaim& claim = faults[onset_s > 3.0].claim;
      EXPECT_EQ(claim.label(), (FaultLabel{FaultKind::torque_loss, 1_joint}));
      EXPECT_NEAR(claim.onset_s, onset_s, 0.05);
      EXPECT_NEAR(claim.end_s, onset_s + kLasts_s, 0.05);
      EXPECT_NEAR(claim.size[0], 0.6, 0.05);
    }
  }
}

TEST(ExplainFaults, ATorqueLossThatPausesForASecondIsTwoFaults) {
  for (const std::uint64_t seed : {26, 28, 29, 30}) {
    const auto faults = faults_of(with_loss_but_for_a_second(seed));
    ASSERT_EQ(faults.size(), 2u) << said(faults);
    EXPECT_EQ(faults[0].label(), (FaultLabel{FaultKind::torque_loss, 1_joint}));
    EXPECT_EQ(faults[1].label(), (FaultLabel{FaultKind::torque_loss, 1_joint}));
    EXPECT_NEAR(faults[0].claim.onset_s, 3.5, 0.05);
    EXPECT_NEAR(faults[0].claim.end_s, 5.5, 0.05);
    EXPECT_NEAR(faults[1].claim.onset_s, 6.5, 0.05);
  }
}

TEST(ExplainFaults, AFalsePositionThatOccursTwiceIsTwoFaults) {
  const auto shift = [](Log& l, int k) { l.q[1][k] += 0.05; };
  Log log = changed(simulate_closed_form(of_day(0), run_of(25)), 2.0, 3.0, shift);
  const auto faults = faults_of(changed(std::move(log), 5.0, 6.0, shift));
  ASSERT_EQ(faults.size(), 2u) << said(faults);
  for (const double onset_s : {2.0, 5.0}) {
    const FaultClaim& claim = faults[onset_s > 3.0].claim;
    EXPECT_EQ(claim.kind, FaultKind::sensor_bias);
    EXPECT_NEAR(claim.onset_s, onset_s, 0.02);
    EXPECT_NEAR(claim.end_s, onset_s + 1.0, 0.02);
    EXPECT_NEAR(claim.size[0], 0.05, 0.005);
  }
}

TEST(ExplainFaults, AnEncoderThatJumpsRepeatedlyInOneDirectionIsOneUnknownFault) {
  Log log = simulate_closed_form(of_day(0), run_of(26));
  for (const double at_s : {3.0, 4.5, 6.0})
    log = changed(std::move(log), at_s, kNeverEnds, [](Log& l, int k) { l.q[1][k] += 0.04; });
  const auto faults = faults_of(std::move(log));
  ASSERT_EQ(faults.size(), 1u) << said(faults);
  EXPECT_EQ(faults[0].label(), (FaultLabel{FaultKind::unknown, 2_joint}));
  EXPECT_NEAR(faults[0].claim.onset_s, 3.0, 0.02);
}

/// A log in which joint 2 has three times its dry friction in the rows that `is_worn` names by time and
/// position.
Log with_more_friction(const std::function<bool(double, double)>& is_worn) {
  return changed(simulate_closed_form(of_day(0), run_of(29)), 0.0, kNeverEnds, [&](Log& log, int k) {
    const ClosedFormScara robot;
    if (is_worn(log.time[k], log.q[1][k]))
      log.tau[1][k] += 2.0 * robot.fc[1] * std::tanh(log.dq[1][k] / robot.width);
  });
}

TEST(ExplainFaults, MoreFrictionInARangeOfPositionsIsOneUnknownFault) {
  const auto faults =
      faults_of(with_more_friction([](double t, double q) { return t > 2.0 && std::abs(q) < 0.3; }));
  ASSERT_EQ(faults.size(), 1u) << said(faults);
  EXPECT_EQ(faults[0].label(), (FaultLabel{FaultKind::unknown, 2_joint}));
  EXPECT_EQ(faults[0].claim.end_s, kNeverEnds);
}

TEST(ExplainFaults, MoreFrictionThatOccursTwiceAtAnyPositionIsTwoFaults) {
  const auto faults = faults_of(
      with_more_friction([](double t, double) { return (t > 2.0 && t < 3.5) || (t > 5.0 && t < 6.5); }));
  ASSERT_EQ(faults.size(), 2u) << said(faults);
  for (const ExplainedFault& fault : faults)
    EXPECT_EQ(fault.label(), (FaultLabel{FaultKind::friction_increase, 2_joint}));
}

TEST(LogFit, ALargeFaultDoesNotDistortTheEffectsOfTheDayBeyondTheirBound) {
  const LogFit fit = fit_of(changed(simulate_closed_form(of_day(0), run_of(24)), 5.0, kNeverEnds,
                                    [](Log& l, int k) { l.tau[1][k] += 60.0 * std::sin(5.0 * l.time[k]); }));
  const Eigen::VectorXd& variance = scara_model().day_variance;
  const Eigen::VectorXd stds = fit.healthy().day.head(variance.size()).cwiseQuotient(variance.cwiseSqrt());
  EXPECT_LT(stds.cwiseAbs().maxCoeff(), 30.01);
}

TEST(ExplainFaults, AFaultFromTheFirstRowOnBeginsWithTheLogAndIsOneFault) {
  const Log log = with_loss(simulate_closed_form(of_day(0), run_of(52)), 2_joint, 0.6, 0.0);
  const ExplainedLog found = explain_faults(on_grid(log), scara_model(), evidence_limits({}), {});
  ASSERT_EQ(found.faults.size(), 1u);
  EXPECT_EQ(found.faults[0].label(), (FaultLabel{FaultKind::torque_loss, 2_joint}));
  EXPECT_EQ(found.faults[0].claim.onset_s, log.time[0]);
}

TEST(LogFit, TheOtherJointsShowAWorkPieceWhileTheSlideIsLocked) {
  ClosedFormRun run = run_of(28);
  run.carries_from_s = 4.5;
  run.carries_to_s = 6.0;
  run.piece_kg = 0.4;
  Log log = simulate_closed_form(of_day(1), run);
  const FaultClaim lock{FaultKind::locked, 3_joint, 3.0};
  for (int k = 0; k < log.rows(); ++k)  // the drive of a locked slide may give what a loaded one asks for
    if (log.time[k] >= lock.onset_s) log.tau[2][k] = 9.81 * (ClosedFormScara{}.m3 + run.piece_kg);
  BalanceModel model = scara_model();
  model.piece_kg = run.piece_kg;
  const LogFit fit(on_grid(std::move(log)), model, {lock});
  for (int k = 0; k < fit.count(); ++k) {
    const double t = fit.time_s()[k];
    if (std::abs(t - run.carries_from_s) < 0.1 || std::abs(t - run.carries_to_s) < 0.1) continue;
    EXPECT_EQ(fit.healthy().path[k] != 0, t > run.carries_from_s && t < run.carries_to_s) << t << " s";
  }
}

TEST(LogFit, AKnownFaultIsAnEffectOfTheLog) {
  Log log = with_loss(simulate_closed_form(of_day(1), run_of(27)), 2_joint, 0.4, 4.0);
  EXPECT_GT(fit_of(log).healthy().mean_square(), 3.0);
  const LogFit known(
      on_grid(std::move(log)), scara_model(),
      {{FaultKind::torque_loss, 2_joint, 4.0, kNeverEnds, Eigen::VectorXd::Constant(1, 0.35)}});
  EXPECT_LT(known.healthy().mean_square(), 1.5);
  EXPECT_NEAR(known.healthy().day[known.healthy().day.size() - 1], 0.05, 0.02);  // beyond the claim's size
}

}  // namespace
}  // namespace faultline
