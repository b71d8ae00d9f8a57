// SPDX-License-Identifier: MIT
#include "lib/diagnose/verdict.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/core/issue.hpp"
#include "lib/log/quality.hpp"
#include "lib/log/recorder/corrected_source.hpp"

namespace faultline {
namespace {

constexpr double kPeriod_s = 0.01;

Diagnosis of_log(std::int64_t rows, std::int64_t judgeable_rows, double period_s = kPeriod_s) {
  Diagnosis diagnosis;
  diagnosis.log.rows_used = rows;
  diagnosis.log.judgeable_rows = judgeable_rows;
  diagnosis.log.sample_period_s = period_s;
  return diagnosis;
}

FaultFinding fault(FaultKind kind, Joint joint, double onset_s, double end_s = 9.0) {
  FaultFinding finding;
  finding.label = {kind, joint};
  finding.onset_s = onset_s;
  finding.end_s = end_s;
  return finding;
}

/// In %, normal within 30.
ConditionItem friction_of(Joint joint, double value, const std::array<double, 2>& ci95) {
  ConditionItem friction;
  friction.what = fmt::format("friction of joint {}", joint);
  friction.value = value;
  friction.ci95 = ci95;
  friction.normal_range = 30.0;
  friction.unit = "%";
  return friction;
}

TEST(Verdict, FaultsAreNumberedByOnsetWithUnknownTimesLast) {
  Diagnosis diagnosis = of_log(1000, 1000);
  const double nowhen = std::numeric_limits<double>::quiet_NaN();
  diagnosis = with_verdict(diagnosis,
                           {fault(FaultKind::locked, 1_joint, nowhen), fault(FaultKind::locked, 2_joint, 2.0),
                            fault(FaultKind::locked, 3_joint, 1.0)},
                           kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::faulty);
  EXPECT_EQ(diagnosis.verdict_reason, "3 faults found");
  ASSERT_EQ(diagnosis.faults.size(), 3u);
  EXPECT_EQ(diagnosis.faults[0].onset_s, 1.0);
  EXPECT_EQ(diagnosis.faults[1].onset_s, 2.0);
  EXPECT_EQ(diagnosis.faults[2].id, 3);
}

TEST(Verdict, AModelWithAGraveDoubtCallsNoLogHealthyButItsFindingsCount) {
  Diagnosis calm = of_log(1000, 1000);
  calm.model.grave_doubts = {"the robot does not explain the logs"};
  Diagnosis faulty = calm;
  calm = with_verdict(calm, {}, kPeriod_s);
  EXPECT_EQ(calm.verdict, Verdict::inconclusive);
  EXPECT_NE(calm.verdict_reason.find("the robot does not explain the logs"), std::string::npos);
  faulty = with_verdict(faulty, {fault(FaultKind::locked, 1_joint, 1.0)}, kPeriod_s);
  EXPECT_EQ(faulty.verdict, Verdict::faulty);
}

FaultFinding sized(double times_least, double onset_s = 1.0) {
  FaultFinding finding = fault(FaultKind::payload_change, 3_joint, onset_s);
  finding.extent = {0.05 * times_least, 0.05, "kg", times_least};
  return finding;
}

TEST(Verdict, AChangeBelowTheLeastSizeIsListedButIsNotAFault) {
  Diagnosis diagnosis = of_log(1000, 1000);
  diagnosis = with_verdict(diagnosis, {sized(0.03)}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::healthy);
  EXPECT_TRUE(diagnosis.faults.empty());
  ASSERT_EQ(diagnosis.small_changes.size(), 1u);
  EXPECT_NE(diagnosis.verdict_reason.find("1 change found, too small"), std::string::npos)
      << diagnosis.verdict_reason;
}

TEST(Verdict, AChangeOfTheLeastSizeIsAFault) {
  Diagnosis diagnosis = of_log(1000, 1000);
  diagnosis = with_verdict(diagnosis, {sized(1.0)}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::faulty);
  EXPECT_TRUE(diagnosis.small_changes.empty());
}

TEST(Verdict, SmallChangesOfOneKindThatReachTheLeastSizeTogetherAreFaults) {
  Diagnosis diagnosis = of_log(1000, 1000);
  diagnosis = with_verdict(diagnosis, {sized(0.6, 1.0), sized(0.6, 5.0)}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::faulty);
  EXPECT_TRUE(diagnosis.small_changes.empty());
}

TEST(Verdict, WithoutFaultsTheLogIsHealthy) {
  Diagnosis diagnosis = of_log(1000, 1000);
  diagnosis = with_verdict(diagnosis, {}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::healthy);
  EXPECT_TRUE(diagnosis.faults.empty());
}

TEST(Verdict, ARobotFarBeyondItsNormalRangeIsNotCalledHealthy) {
  Diagnosis diagnosis = of_log(1000, 1000);
  diagnosis.condition = {friction_of(3_joint, 113.0, {99.0, 128.0})};
  diagnosis = with_verdict(diagnosis, {}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::inconclusive);
  EXPECT_NE(diagnosis.verdict_reason.find("friction of joint 3 (+113 %"), std::string::npos);
}

TEST(Verdict, TheReasonNamesAnEffectBeyondItsNormalRange) {
  Diagnosis diagnosis = of_log(1000, 1000);
  diagnosis.condition = {friction_of(1_joint, 50.0, {45.0, 55.0})};
  diagnosis = with_verdict(diagnosis, {}, kPeriod_s);
  EXPECT_NE(diagnosis.verdict_reason.find("beyond its normal range: friction of joint 1 (+50 %"),
            std::string::npos);
}

TEST(Verdict, ALogThatCannotBeJudgedHasNoFaults) {
  const std::vector<FaultFinding> faults = {fault(FaultKind::locked, 1_joint, 1.0)};
  for (Diagnosis diagnosis : {of_log(1000, 1000, 1.4 * kPeriod_s), of_log(1000, 1000, kPeriod_s / 1.4),
                              of_log(19, 19), of_log(1000, 199)}) {
    diagnosis.condition.resize(1);
    diagnosis = with_verdict(diagnosis, faults, kPeriod_s);
    EXPECT_EQ(diagnosis.verdict, Verdict::inconclusive);
    EXPECT_NE(diagnosis.verdict_reason, "");
    EXPECT_TRUE(diagnosis.faults.empty());
    EXPECT_TRUE(diagnosis.condition.empty());
  }
}

TEST(Verdict, AMisreadLogHasNoFaultAndItsReasonNamesTheCause) {
  Diagnosis diagnosis = of_log(1000, 1000);
  diagnosis.log.issues.add(make_issue(kMisreadLog, Severity::severe, "it looks as if q2 is in degrees"));
  diagnosis = with_verdict(diagnosis, {fault(FaultKind::locked, 1_joint, 1.0)}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::inconclusive);
  EXPECT_EQ(diagnosis.verdict_reason, "it looks as if q2 is in degrees");
  EXPECT_TRUE(diagnosis.faults.empty());
}

TEST(Verdict, ALogWhoseColumnsChangeHasNoFaultAndNamesTheRow) {
  Diagnosis diagnosis = of_log(1000, 1000);
  diagnosis.log.issues.add(
      make_issue(kChangedColumns, Severity::severe, "row 301: joints 1 and 2 are swapped"));
  diagnosis = with_verdict(diagnosis, {fault(FaultKind::locked, 1_joint, 1.0)}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::inconclusive);
  EXPECT_EQ(diagnosis.verdict_reason, "row 301: joints 1 and 2 are swapped");
  EXPECT_TRUE(diagnosis.faults.empty());
}

TEST(Verdict, AScaledClockForbidsANamedFaultButNotAHealthyVerdict) {
  for (const bool with_fault : {false, true}) {
    Diagnosis diagnosis = of_log(1000, 1000);
    diagnosis.log.issues.add(make_issue(kScaledMotion, Severity::warning, "the clock is scaled"));
    std::vector<FaultFinding> faults;
    if (with_fault) faults.push_back(fault(FaultKind::sensor_drift, 1_joint, 1.0));
    diagnosis = with_verdict(diagnosis, faults, kPeriod_s);
    EXPECT_EQ(diagnosis.verdict, with_fault ? Verdict::inconclusive : Verdict::healthy);
    EXPECT_TRUE(diagnosis.faults.empty());
    EXPECT_EQ(diagnosis.verdict_reason.find("the clock is scaled") != std::string::npos, with_fault);
  }
}

TEST(Verdict, ASevereIssueForbidsHealthyAndHidesNoFault) {
  for (const bool with_fault : {false, true}) {
    Diagnosis diagnosis = of_log(1000, 1000);
    diagnosis.log.issues.add(make_issue("unit_implausible", Severity::severe, "q1 looks like degrees"));
    std::vector<FaultFinding> faults;
    if (with_fault) faults.push_back(fault(FaultKind::locked, 1_joint, 1.0));
    diagnosis = with_verdict(diagnosis, faults, kPeriod_s);
    EXPECT_EQ(diagnosis.verdict, with_fault ? Verdict::faulty : Verdict::inconclusive);
    EXPECT_EQ(diagnosis.verdict_reason.find("q1 looks like degrees") != std::string::npos, !with_fault);
  }
}

TEST(MergeFaults, AFaultThatPausesIsOneFinding) {
  const auto merged = merge_continued({fault(FaultKind::locked, 2_joint, 1.0, 2.0),
                                       fault(FaultKind::locked, 2_joint, 2.5, 4.0),
                                       fault(FaultKind::locked, 1_joint, 3.5, 5.0)});
  ASSERT_EQ(merged.size(), 2u);
  EXPECT_EQ(merged[0].label.joint, 2_joint);
  EXPECT_EQ(merged[0].end_s, 4.0);
  EXPECT_EQ(merged[1].label.joint, 1_joint);
}

TEST(MergeFaults, AFaultThatBeginsDuringAnotherAtTheSameJointIsSeparate) {
  EXPECT_EQ(merge_continued({fault(FaultKind::payload_change, 3_joint, 2.0, 9.0),
                             fault(FaultKind::torque_loss, 3_joint, 5.0, 9.0)})
                .size(),
            2u);
  EXPECT_EQ(merge_continued({fault(FaultKind::payload_change, 3_joint, 2.0, 9.0),
                             fault(FaultKind::payload_change, 3_joint, 5.0, 9.0)})
                .size(),
            2u)
      << "the load changes twice";
}

TEST(MergeFaults, APushAtTheEndOfAFaultIsPartOfItButAPushDuringItIsNot) {
  const FaultFinding friction = fault(FaultKind::friction_increase, 2_joint, 1.0, 4.0);
  const auto ends = merge_continued({friction, fault(FaultKind::collision, 2_joint, 3.9, 4.4)});
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_EQ(ends[0].end_s, 4.4);
  EXPECT_EQ(merge_continued({friction, fault(FaultKind::collision, 2_joint, 2.5, 2.6)}).size(), 2u);
}

TEST(MergeFaults, CollisionsStaySeparate) {
  const auto merged = merge_continued(
      {fault(FaultKind::collision, 2_joint, 1.0, 1.1), fault(FaultKind::collision, 2_joint, 3.0, 3.1)});
  EXPECT_EQ(merged.size(), 2u);
}

TEST(MergeFaults, APushJustBeforeAnUnknownDisturbanceIsItsBeginning) {
  const auto merged = merge_continued(
      {fault(FaultKind::collision, 2_joint, 1.0, 1.1), fault(FaultKind::unknown, Joint(), 1.6, 5.0),
       fault(FaultKind::collision, 1_joint, 5.5, 5.6), fault(FaultKind::collision, 1_joint, 8.0, 8.1)});
  ASSERT_EQ(merged.size(), 2u);
  EXPECT_EQ(merged[0].label.kind, FaultKind::unknown);
  EXPECT_EQ(merged[0].onset_s, 1.0);
  EXPECT_EQ(merged[0].end_s, 5.6) << "a push that follows at once is part of it";
  EXPECT_EQ(merged[1].label.kind, FaultKind::collision);
}

TEST(MergeFaults, AShortDisturbanceJustBeforeALastingFaultIsItsOnset) {
  FaultFinding shaking = fault(FaultKind::unknown, Joint(), 1.0, 1.3);
  shaking.could_also_be.emplace_back().label = {FaultKind::collision, 2_joint};
  const auto merged = merge_continued({shaking, fault(FaultKind::locked, 2_joint, 1.6, 9.0)});
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_EQ(merged[0].label.kind, FaultKind::locked);
  EXPECT_EQ(merged[0].onset_s, 1.0);
  EXPECT_EQ(merge_continued({shaking, fault(FaultKind::locked, 3_joint, 1.6, 9.0)}).size(), 2u)
      << "another joint";
  EXPECT_EQ(merge_continued({shaking, fault(FaultKind::locked, 2_joint, 2.1, 9.0)}).size(), 2u)
      << "much later";
  shaking.end_s = 4.0;
  EXPECT_EQ(merge_continued({shaking, fault(FaultKind::locked, 2_joint, 4.1, 9.0)}).size(), 2u)
      << "nothing shakes that long";
}

TEST(MergeFaults, APushLongBeforeAnUnknownDisturbanceStaysSeparate) {
  const auto merged = merge_continued(
      {fault(FaultKind::collision, 2_joint, 1.0, 1.1), fault(FaultKind::unknown, Joint(), 2.2, 5.0)});
  EXPECT_EQ(merged.size(), 2u);
}

TEST(Verdict, AModelThatFindsFewFaultsCannotCallALogHealthy) {
  Diagnosis diagnosis;
  diagnosis.log.sample_period_s = kPeriod_s;
  diagnosis.log.rows_used = diagnosis.log.judgeable_rows = 1000;
  diagnosis = with_verdict(diagnosis, {}, kPeriod_s, 0.2);
  EXPECT_EQ(diagnosis.verdict, Verdict::inconclusive);
  EXPECT_NE(diagnosis.verdict_reason.find("20 %"), std::string::npos) << diagnosis.verdict_reason;
  diagnosis = with_verdict(diagnosis, {}, kPeriod_s, 0.9);
  EXPECT_EQ(diagnosis.verdict, Verdict::healthy);
}

TEST(Verdict, ALogWithManyTimesLargerResidualsIsNotCalledHealthy) {
  Diagnosis diagnosis = of_log(1000, 1000);
  diagnosis.roughness = {1.0, 2.4, 4.8};
  diagnosis = with_verdict(diagnosis, {}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::inconclusive);
  EXPECT_NE(diagnosis.verdict_reason.find("4.8 times as large at joint 3"), std::string::npos);
  diagnosis.roughness[2] = 2.4;
  diagnosis = with_verdict(diagnosis, {}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::healthy);
}

TEST(Verdict, ALogOfWhichLittleCouldBeExplainedIsNotCalledHealthy) {
  Diagnosis diagnosis = of_log(1000, 1000);
  diagnosis.judged_share = 0.4;
  diagnosis = with_verdict(diagnosis, {}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::inconclusive);
  EXPECT_NE(diagnosis.verdict_reason.find("only 40 % of the log"), std::string::npos);
  diagnosis.judged_share = 0.9;
  diagnosis = with_verdict(diagnosis, {}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::healthy);
}

TEST(Verdict, ALogInWhichNoJointMovesIsNotCalledHealthy) {
  Diagnosis diagnosis = of_log(1000, 1000);
  diagnosis.log.joints = 3;
  diagnosis.log.resting = {1_joint, 2_joint, 3_joint};
  diagnosis = with_verdict(diagnosis, {}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::inconclusive);
  EXPECT_NE(diagnosis.verdict_reason.find("no joint moved"), std::string::npos);
  diagnosis.log.resting = {1_joint, 3_joint};
  diagnosis = with_verdict(diagnosis, {}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::healthy);
}

TEST(Verdict, AFaultIsReportedDespiteLargeResiduals) {
  Diagnosis diagnosis = of_log(1000, 1000);
  diagnosis.roughness = {9.0};
  diagnosis = with_verdict(diagnosis, {fault(FaultKind::locked, 1_joint, 2.0)}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::faulty);
}

TEST(Verdict, ALogWithAnExtremeResidualPeakIsNotCalledHealthy) {
  Diagnosis diagnosis = of_log(1000, 1000);
  diagnosis.residuals = {{1_joint, 1.1, 55.0, 3.0}, {2_joint, 4.4, 276.0, 12.22}};
  diagnosis = with_verdict(diagnosis, {}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::inconclusive);
  EXPECT_NE(diagnosis.verdict_reason.find("joint 2 at 12.220 s"), std::string::npos);
  diagnosis.residuals[1].velocity_peak = 61.0;
  diagnosis = with_verdict(diagnosis, {}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::healthy);
}

TEST(Verdict, ALongUnjudgedStretchForbidsHealthyAndIsNamedInTheReason) {
  Diagnosis diagnosis = of_log(1000, 700);
  diagnosis.log.end_s = 10.0;
  diagnosis.log.unjudged = {{2_joint, 7.0, 10.0, false, true}, {1_joint, 3.0, 4.0, true, false}};
  diagnosis = with_verdict(diagnosis, {}, kPeriod_s);
  EXPECT_EQ(diagnosis.verdict, Verdict::inconclusive);
  EXPECT_EQ(
      diagnosis.verdict_reason,
      "no fault was found in the judged part of the log, but joint 2 could not be judged from 7.000 s to "
      "10.000 s, the end of the log: its torque is missing (and 1 other stretch); a fault may be missed if a "
      "joint is not judged for longer than 0.5 s, in more than a quarter of 5 s, or at the end");
}

TEST(Verdict, NamesTheWholeLogOnlyIfAllOfItWasJudged) {
  Diagnosis whole = of_log(1000, 1000), lost = of_log(1000, 1000), one_run = of_log(1000, 1000);
  whole = with_verdict(whole, {}, kPeriod_s);
  EXPECT_EQ(whole.verdict_reason, "the identified robot explains the whole log");
  lost.log.is_whole = false;
  lost.log.rows_unjudged = 3;
  lost.log.rows_read = 1000;
  lost = with_verdict(lost, {}, kPeriod_s);
  EXPECT_EQ(lost.verdict, Verdict::healthy);
  EXPECT_EQ(lost.verdict_reason.find("whole log"), std::string::npos);
  EXPECT_NE(lost.verdict_reason.find("3 of 1000 rows"), std::string::npos);
  one_run.log.runs = {{.run = 1, .is_read = false}, {.run = 2}, {.run = 3, .is_read = false}};
  one_run = with_verdict(one_run, {}, kPeriod_s);
  EXPECT_NE(one_run.verdict_reason.find("run 2 of 3"), std::string::npos) << one_run.verdict_reason;
}

}  // namespace
}  // namespace faultline
