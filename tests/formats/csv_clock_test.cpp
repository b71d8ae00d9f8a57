// SPDX-License-Identifier: MIT
// Times as people and controllers write them: dates in several orders, date and time in two columns.
#include <cmath>
#include <limits>

#include "formats/csv/clock_text.hpp"
#include "tests/formats/read_csv.hpp"
#include "tests/support/shared_data.hpp"

namespace faultline {
namespace {

using Values = std::vector<double>;

/// 2024-03-13 12:00:00 UTC, in s since 1970, and a day.
constexpr double kNoon = 1710331200.0, kDay = 86400.0;

double seconds_of(const char* text, bool day_first = false) {
  const auto clock = read_clock(text, day_first);
  return clock ? clock->seconds : std::numeric_limits<double>::quiet_NaN();
}

TEST(ClockText, DatesAreReadInTheUsualOrders) {
  for (const char* text : {"2024-03-13", "2024/03/13", "2024/3/13", "13.03.2024", "13.3.2024", "13.03.24"})
    EXPECT_EQ(seconds_of(text), kNoon - kDay / 2) << text;
  EXPECT_EQ(seconds_of("03/13/2024"), kNoon - kDay / 2);
  EXPECT_EQ(seconds_of("13/03/2024", true), kNoon - kDay / 2);
  EXPECT_EQ(seconds_of("13-03-2024", true), kNoon - kDay / 2);
}

TEST(ClockText, TimesBehindADateOrAloneAreRead) {
  for (const char* text : {"2024-03-13T12:00:00", "2024-03-13 12:00:00Z", "13.03.2024 12:00:00,000",
                           "13.03.2024  12:00:00.0", "3/13/2024 12:00:00 PM", "2024-03-13T14:00:00+02:00"})
    EXPECT_EQ(seconds_of(text), kNoon) << text;
  EXPECT_EQ(seconds_of("9:05:07"), 32707.0);
  EXPECT_EQ(seconds_of("09:05:07 am"), 32707.0);
  EXPECT_EQ(seconds_of("9:05:07.25 PM"), 75907.25);
  EXPECT_EQ(seconds_of("12:00:00 AM"), 0.0);
  EXPECT_EQ(seconds_of("12:30:00PM"), 45000.0);
}

TEST(ClockText, OtherTextsAreNoTimes) {
  for (const char* text :
       {"", "2024", "12:00", "13:00:00 PM", "0:30:00 AM", "2024-13-01", "31.02.2024", "13/13/2024", "1.2.3",
        "1.2.24", "10.0.0.1", "2024-03-13x", "2024-03/13", "12:00:00+02:00", "25:00:00", "2024-03-13 ",
        "2024-03-13T", "99999999999999999999999-01-01", "V2024-03-13"})
    EXPECT_TRUE(std::isnan(seconds_of(text))) << text;
}

TEST(ClockText, TheOrderOfADateIsKnownIfOneNumberIsNoMonth) {
  EXPECT_EQ(read_clock("03/13/2024", false)->order, DateOrder::month_first);
  EXPECT_EQ(read_clock("13/03/2024", true)->order, DateOrder::day_first);
  EXPECT_EQ(read_clock("03/04/2024", false)->order, DateOrder::either);
  EXPECT_EQ(read_clock("03.04.2024", false)->order, DateOrder::certain);
}

TEST(CsvClock, DateAndTimeInTwoColumnsAreOneClockUnderAnyNames) {
  const auto [log, identity, issues] = read_csv(
      "Datum;Uhrzeit;q1;q2\n12.03.2024;23:59:59,750;1,5;2\n13.03.2024;00:00:00,000;2,5;3\n"
      "13.03.2024;00:00:00,250;3,5;4\n");
  EXPECT_EQ(log.time, (Values{kNoon - kDay / 2 - 0.25, kNoon - kDay / 2, kNoon - kDay / 2 + 0.25}));
  EXPECT_EQ(log.q[0], (Values{1.5, 2.5, 3.5}));
  EXPECT_TRUE(issues.empty()) << issues.all()[0].message;
}

TEST(CsvClock, DateAndTimeMayHaveTheNamesOfATimeAndBlanksBetweenThem) {
  for (const char* header : {"Date Time q1", "time clock q1", "a b q1"}) {
    const Log log =
        read_csv(header + std::string("\n2024-03-13 12:00:00.5 1\n2024-03-13 12:00:01.0 2\n")).log;
    EXPECT_EQ(log.time, (Values{kNoon + 0.5, kNoon + 1})) << header;
  }
}

TEST(CsvClock, TheDateHoldsWhereALaterHeaderHasTheColumnsInAnotherOrder) {
  const Log log = read_csv(
                      "date,clock,q1\n2024-03-13,12:00:00,1\n2024-03-13,12:00:01,2\n"
                      "2024-03-13,12:00:01.5,2.5\nq1,clock,date\n"
                      "3,12:00:02,2024-03-13\n4,12:00:03,2024-03-13\n")
                      .log;
  EXPECT_EQ(log.time, (Values{kNoon, kNoon + 1, kNoon + 1.5, kNoon + 2, kNoon + 3}));
  EXPECT_EQ(log.q[0], (Values{1, 2, 2.5, 3, 4}));
}

TEST(CsvClock, ARowWithoutItsDateHasNoTime) {
  const auto [log, identity, issues] =
      read_csv("date,clock,q1\n2024-03-13,12:00:00,1\n,12:00:01,2\n2024-03-13,12:00:02,3\n");
  EXPECT_EQ(log.q[0], (Values{1, 3}));
  EXPECT_NE(issues.find("time_missing", "t"), nullptr);
}

TEST(CsvClock, ANumberCalledTimeIsPreferredToADate) {
  const Log log = read_csv("date,clock,t,q1\n2024-03-13,12:00:00,5,1\n2024-03-13,12:00:00,6,2\n").log;
  EXPECT_EQ(log.time, (Values{5, 6}));
}

TEST(CsvClock, ATimeOfDayNeedsNoNameOfATime) {
  EXPECT_EQ(read_csv("Uhrzeit;q1\n12:00:00;1\n12:00:01;2\n").log.time, (Values{43200, 43201}));
  EXPECT_EQ(read_csv("Aufgezeichnet;q1\n13.03.2024 12:00:00;1\n13.03.2024 12:00:01;2\n").log.time,
            (Values{kNoon, kNoon + 1}));
}

TEST(CsvClock, ADateAboveTheHeaderOfATableOfTwoColumnsIsNoRow) {
  const auto [log, identity, issues] = read_csv("Robot,7-b\nDate,13.03.2024\nSpeed,5\nt,q1\n0,1\n1,x\n2,3\n");
  EXPECT_EQ(log.time, (Values{0, 1, 2}));
  EXPECT_EQ(identity.rows_read, 3);
  ASSERT_NE(issues.find("preamble_skipped"), nullptr);
  EXPECT_EQ(issues.find("preamble_skipped")->count, 3);
}

TEST(CsvClock, ADayAbove12ShowsTheOrderOfAllDates) {
  const auto [log, identity, issues] =
      read_csv("stamp,q1\n12/03/2024 23:59:59,1\n13/03/2024 00:00:00,2\n13/03/2024 00:00:01,3\n");
  EXPECT_EQ(log.time, (Values{kNoon - kDay / 2 - 1, kNoon - kDay / 2, kNoon - kDay / 2 + 1}));
  EXPECT_EQ(issues.find("date_order_assumed"), nullptr);
}

TEST(CsvClock, AnOrderThatNoDateShowsIsAssumedAndReported) {
  const auto [log, identity, issues] =
      read_csv("stamp,q1\n03/04/2024 12:00:00 PM,1\n03/04/2024 12:00:01 PM,2\n");
  EXPECT_EQ(log.time[0], kNoon - 9 * kDay);  // 2024-03-04
  const Issue* issue = issues.find("date_order_assumed", "t");
  ASSERT_NE(issue, nullptr);
  EXPECT_NE(issue->message.find("month first"), std::string::npos) << issue->message;
}

TEST(CsvClock, ACountOf100NanosecondsSince1601IsRecognisedByItsSize) {
  const Log log = read_csv("timestamp,q1\n133548048000000000,1\n133548048000020000,2\n").log;
  EXPECT_NEAR(log.time[0], kNoon, 2e-6);
  EXPECT_NEAR(log.time[1] - log.time[0], 0.002, 4e-6);
}

TEST(CsvClock, RowsThatARecorderWroteOutOfOrderAllFindTheirPlaces) {
  const std::filesystem::path folder = shared_data();
  if (folder.empty()) return;
  OpenLogOptions options;
  options.columns["t"] = {.name = "column3"};
  for (int j = 0; j < 6; ++j) {
    const std::string joint = std::to_string(j + 1);
    options.columns["q" + joint] = {.name = "column" + std::to_string(4 + j), .unit = "deg"};
    options.columns["dq" + joint] = {.name = "column" + std::to_string(16 + j), .unit = "deg/s"};
  }
  const auto source = open_log((folder / "doosan" / "free_as_recorded_3000_rows.txt").string(), options);
  const Log log = read_all(*source);
  const Issues issues = source->issues();
  EXPECT_EQ(log.rows(), 3000);
  EXPECT_EQ(issues.rows_dropped(), 0);
  const Issue* late = issues.find("time_out_of_order", "t");
  ASSERT_NE(late, nullptr);
  EXPECT_GT(late->count, 100);
  for (int i = 1; i < log.rows(); ++i) ASSERT_GT(log.time[i], log.time[i - 1]) << i;
}

}  // namespace
}  // namespace faultline
