// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/diagnose/decide_episode.hpp"
#include "tests/diagnose/hand_made_episode.hpp"

namespace faultline {
namespace {

/// Simulated cases just like the episode, and others of it that are less so.
class Precedents : public testing::Test {
 protected:
  std::int64_t add(const std::string& origin, CaseOutcome outcome, double aside, const FaultLabel& label) {
    Case c;
    c.episode = seen(episode_, model_);
    c.episode.features.back() += aside;
    c.decision = c.label = label;
    c.origin = origin;
    c.outcome = outcome;
    c.person = origin == "night.csv" ? "A. Weber" : "";
    return base_.retain(c);
  }

  FaultFinding finding() const { return decide_episode(episode_, model_, base_); }

  Model model_ = hand_made_rrp({kLocked2, 0.9}, {kStuck2, 0.8});
  MonitoredEpisode episode_ = [] {
    MonitoredEpisode episode = episode_of_fault(kLocked2);
    explain_alike(episode, kStuck2, 99.0);
    return episode;
  }();
  CaseBase base_ = empty_base(model_);
};

TEST_F(Precedents, ConfirmedFieldCasesComeFirstThenLabelledLogsThenSimulatedOnes) {
  add(kSimulatedOrigin, CaseOutcome::confirmed, 0.0, kLocked2);
  const auto labelled = add(kLabelledOrigin, CaseOutcome::confirmed, 1.0, kLocked2);
  const auto diagnosed = add("day.csv", CaseOutcome::unconfirmed, 0.5, kLocked2);
  const auto field = add("night.csv", CaseOutcome::confirmed, 2.0, kLocked2);
  const auto nearer = add("night.csv", CaseOutcome::confirmed, 1.5, kLocked2);
  const std::vector<Precedent> shown = finding().precedents;
  ASSERT_EQ(shown.size(), 5u);
  EXPECT_EQ(shown[0].case_id, nearer);
  EXPECT_EQ(shown[1].case_id, field);
  EXPECT_EQ(shown[2].case_id, labelled);
  EXPECT_EQ(shown[3].case_id, diagnosed);
  EXPECT_EQ(shown[4].origin, CaseOrigin::simulated);
  EXPECT_EQ(shown[0].person, "A. Weber");
  EXPECT_NE(shown[0].origin_text.find("confirmed in the field by A. Weber"), std::string::npos);
}

TEST_F(Precedents, AFieldCaseLessSimilarThanTheVotersIsShownWithoutAVote) {
  for (int i = 0; i < 9; ++i) add(kSimulatedOrigin, CaseOutcome::confirmed, 0.0, kLocked2);
  const FaultFinding without = finding();
  add("night.csv", CaseOutcome::confirmed, 1.0, kStuck2);
  const FaultFinding with = finding();
  EXPECT_EQ(with.label, without.label);
  EXPECT_EQ(with.confidence, without.confidence);
  ASSERT_EQ(with.precedents.size(), 8u);
  EXPECT_EQ(with.precedents[0].origin, CaseOrigin::field);
  EXPECT_FALSE(with.precedents[0].voted);
  EXPECT_TRUE(with.precedents[1].voted);
}

TEST_F(Precedents, ACaseThatIsNotSimilarIsNotShownWhateverItsOrigin) {
  add(kSimulatedOrigin, CaseOutcome::confirmed, 0.0, kLocked2);
  const auto far = add("night.csv", CaseOutcome::confirmed, 0.0, kLocked2);
  Case c = base_.at(far);
  for (double& x : c.episode.features) x += 9.0;
  base_.replace(c);
  ASSERT_EQ(finding().precedents.size(), 1u);
  EXPECT_EQ(finding().precedents[0].origin, CaseOrigin::simulated);
}

TEST_F(Precedents, ListTheFeaturesThatAgreeAndThoseThatDiffer) {
  for (const FaultLabel& label : {kBias3, kPush1, kLoss1}) {  // so that some things are unusual
    Case c;
    c.episode = seen(episode_of_fault(label), model_);
    c.decision = c.label = label;
    c.origin = kSimulatedOrigin;
    base_.retain(c);
  }
  const auto id = add("night.csv", CaseOutcome::confirmed, std::log(20.0), kLocked2);
  const std::vector<Precedent> shown = finding().precedents;
  ASSERT_EQ(shown[0].case_id, id);
  ASSERT_FALSE(shown[0].alike.empty());
  const auto behind = std::find_if(shown[0].alike.begin(), shown[0].alike.end(),
                                   [](const auto& f) { return f.name == "behind locked 2"; });
  ASSERT_NE(behind, shown[0].alike.end());
  EXPECT_EQ(behind->here, 0.0);
  ASSERT_EQ(shown[0].unlike.size(), 1u);
  EXPECT_EQ(shown[0].unlike[0].what, "MLP residual of joint 3");
  EXPECT_NEAR(shown[0].unlike[0].there, 20.0, 1e-9);
  EXPECT_NEAR(shown[0].unlike[0].here, 1.0, 1e-9);
}

TEST_F(Precedents, VotesOfSimulatedCasesAloneAreMarkedAsSimulated) {
  for (int i = 0; i < 5; ++i) add(kSimulatedOrigin, CaseOutcome::confirmed, 0.0, kLocked2);
  const auto decision = [this] {
    std::string text;
    for (const EvidenceItem& item : finding().evidence)
      if (item.name == "decision") text = item.text;
    return text;
  };
  EXPECT_NE(decision().find("5 similar cases, all simulated,"), std::string::npos) << decision();
  add("night.csv", CaseOutcome::confirmed, 0.0, kLocked2);
  EXPECT_EQ(decision().find("all simulated"), std::string::npos) << decision();
}

}  // namespace
}  // namespace faultline
