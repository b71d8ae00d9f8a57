// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/classify/episode_features.hpp"
#include "lib/evidence/watch/episode_detector.hpp"
#include "lib/fault/label_text.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {
namespace {

constexpr double kFirst_s = 2.003, kSecond_s = 5.004;
constexpr double kLasting_s = 1e9;

struct Found {
  std::string label;
  EpisodeEvidence evidence;
};

SimulatedFault fault(FaultKind kind, int joint, double onset_s, double size, double length_s = kLasting_s) {
  return rrp_run_with(kind, joint, onset_s, size, length_s).faults.front();
}

/// What is found in a run of 9 s with these faults.
std::vector<Found> found(const std::vector<SimulatedFault>& faults) {
  SimulationSpec run = rrp_run(9.0);
  run.faults = faults;
  const MotionModel& model = rrp_motion_model();
  const std::vector<Hypothesis> bank = hypotheses_of(model.joints(), TorqueMeaning::commanded);
  EpisodeDetector detector(model, bank, {});
  MemorySource source(simulate(known_rrp(), run, 5).log, "memory");
  for (Log segment; source.next(segment);) detector.take(segment);
  detector.finish();
  std::vector<Found> out;
  for (const EpisodeEvidence& episode : detector.episodes())
    out.push_back({label_text(likeliest(evidence_by_label(episode, bank, model)).label), episode});
  return out;
}

std::string listed(const std::vector<Found>& faults) {
  std::string text;
  for (const Found& each : faults)
    text += each.label + " from " + std::to_string(each.evidence.onset_s) + " to " +
            std::to_string(each.evidence.end_s) + "; ";
  return text;
}

std::string text(FaultKind kind, int joint) { return label_text({kind, joint}); }

/// A grave fault three seconds after another one, on another joint.
struct Pair {
  FaultKind first;
  int first_joint;
  double first_size;
  FaultKind second;
  int second_joint;
};

void PrintTo(const Pair& pair, std::ostream* out) {
  *out << text(pair.first, pair.first_joint) << " then " << text(pair.second, pair.second_joint);
}

class AfterAnotherFault : public testing::TestWithParam<Pair> {};

TEST_P(AfterAnotherFault, AGraveFaultIsListedToo) {
  const Pair& pair = GetParam();
  const auto faults = found({fault(pair.first, pair.first_joint, kFirst_s, pair.first_size),
                             fault(pair.second, pair.second_joint, kSecond_s, 0.0)});
  ASSERT_EQ(faults.size(), 2u) << listed(faults);
  EXPECT_EQ(faults[0].label, text(pair.first, pair.first_joint));
  // A lock may hide at rest, and friction begins among what the model misses anyway.
  const bool begins_hidden = pair.first == FaultKind::locked || pair.first == FaultKind::friction_increase;
  EXPECT_NEAR(faults[0].evidence.onset_s, kFirst_s, begins_hidden ? 0.3 : 0.06);
  EXPECT_EQ(faults[1].label, text(pair.second, pair.second_joint));
  EXPECT_NEAR(faults[1].evidence.onset_s, kSecond_s, 0.02);
}

INSTANTIATE_TEST_SUITE_P(
    EpisodeDetector, AfterAnotherFault,
    testing::Values(Pair{FaultKind::friction_increase, 1, 3.0, FaultKind::free_swinging, 2},
                    Pair{FaultKind::torque_loss, 1, 0.4, FaultKind::locked, 2},
                    Pair{FaultKind::free_swinging, 2, 0.0, FaultKind::locked, 1},
                    Pair{FaultKind::locked, 2, 0.0, FaultKind::free_swinging, 1},
                    Pair{FaultKind::sensor_bias, 2, 0.02, FaultKind::locked, 1},
                    Pair{FaultKind::sensor_drift, 2, 0.02, FaultKind::free_swinging, 1},
                    Pair{FaultKind::stuck_encoder, 3, 0.0, FaultKind::free_swinging, 1},
                    Pair{FaultKind::payload_change, 3, 1.0, FaultKind::free_swinging, 2}));

TEST(FaultsInSequence, ALossThatComesTwiceIsTwoFaultsThatEnd) {
  const auto faults = found(
      {fault(FaultKind::torque_loss, 1, 2.0, 0.6, 1.5), fault(FaultKind::torque_loss, 1, 6.0, 0.6, 1.5)});
  ASSERT_EQ(faults.size(), 2u);
  for (const Found& each : faults) EXPECT_EQ(each.label, text(FaultKind::torque_loss, 1));
  EXPECT_NEAR(faults[0].evidence.end_s, 3.5, 0.1);
  EXPECT_NEAR(faults[1].evidence.onset_s, 6.0, 0.05);
  EXPECT_NEAR(faults[1].evidence.end_s, 7.5, 0.1);
}

TEST(FaultsInSequence, AFaultThatStaysLastsUntilTheLogEnds) {
  for (const FaultKind kind :
       {FaultKind::torque_loss, FaultKind::sensor_bias, FaultKind::friction_increase}) {
    const double size = kind == FaultKind::torque_loss ? 0.5 : kind == FaultKind::sensor_bias ? 0.02 : 3.0;
    const auto faults = found({fault(kind, 1, 2.0, size)});
    ASSERT_EQ(faults.size(), 1u) << text(kind, 1);
    EXPECT_NEAR(faults[0].evidence.end_s, 9.0, 0.01) << text(kind, 1);
  }
}

TEST(FaultsInSequence, APushEndsWhenItEnds) {
  const auto faults = found({fault(FaultKind::collision, 1, 2.0, 40.0, 0.1)});
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NEAR(faults[0].evidence.end_s, 2.1, 0.05);
}

/// Half a second of force that no short pulse explains.
TEST(FaultsInSequence, ALongPushIsOneCollisionThatEnds) {
  const auto faults = found({fault(FaultKind::collision, 1, 2.0, 30.0, 0.45)});
  ASSERT_EQ(faults.size(), 1u) << listed(faults);
  EXPECT_EQ(faults[0].label, text(FaultKind::collision, 1));
  EXPECT_NEAR(faults[0].evidence.end_s, 2.45, 0.04);
}

}  // namespace
}  // namespace faultline
