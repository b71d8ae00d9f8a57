// SPDX-License-Identifier: MIT
#include "apps/service/job_run.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "apps/service/condition_view.hpp"
#include "apps/service/job_queue.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

const std::string kSampleLogs = std::string(FAULTLINE_SOURCE_DIR) + "/sample_logs/";

/// A folder with the model of the golden logs and a queue without the pages.
class JobsOfAFolder : public testing::Test {
 protected:
  JobsOfAFolder() {
    fs::copy_file(kSampleLogs + "golden/model-749d7413.json", files_.file("bench.model"));
    fs::copy_file(kSampleLogs + "golden/cases-18392bf9.db", files_.file("bench.model.cases.db"));
  }

  /// A job of a sample log that has not run.
  Job new_job(std::int64_t id, const std::string& log) {
    const std::string incoming = folder_.new_incoming();
    fs::create_directory(incoming + "/logs");
    fs::copy_file(kSampleLogs + "bench/" + log, incoming + "/logs/" + log);
    write_request(incoming, {JobKind::diagnose, "bench.model", {log}, {}, 0});
    folder_.take_in(incoming, id);
    return read_job(folder_.job_path(id), id);
  }

  JobOutcome run(const Job& job) {
    return run_job(folder_, job, process_, [](const std::string&, double) { return true; });
  }

  TemporaryFolder files_;
  ServiceFolder folder_{files_.path().string()};
  JobProcess process_{FAULTLINE_PROGRAM, 600.0};
};

TEST_F(JobsOfAFolder, ADiagnosisIsDoneAndASecondRunWritesTheSame) {
  const Job job = new_job(1, "locked_1.csv");
  const JobOutcome outcome = run(job);
  EXPECT_EQ(outcome.state, JobState::done);
  EXPECT_EQ(outcome.sentence, "joint 1 is locked, from 8.440 s on");
  const std::string report = read_file(folder_.job_path(1) + "/report.html");
  EXPECT_EQ(run(job).sentence, outcome.sentence);
  EXPECT_EQ(read_file(folder_.job_path(1) + "/report.html"), report);
}

TEST_F(JobsOfAFolder, AJobWhoseModelIsGoneIsAnError) {
  const Job job = new_job(1, "locked_1.csv");
  fs::remove(files_.file("bench.model"));
  EXPECT_THROW(run(job), Error);
}

TEST_F(JobsOfAFolder, AModelIsPublishedOnceAndNeverOverAnother) {
  const std::string learned = files_.file("serve/learned.model");
  const auto make = [&] {
    write_file(learned, "a model");
    write_file(learned + ".cases.db", "cases");
  };
  make();
  folder_.publish_model(learned, "new.model");
  EXPECT_TRUE(folder_.has_model("new.model"));
  EXPECT_FALSE(fs::exists(learned));
  make();
  folder_.publish_model(learned, "new.model");  // as after a kill between the move and the outcome
  make();
  EXPECT_THROW(folder_.publish_model(learned, "bench.model"), Error);
  write_file(files_.file("alone.model"), "another model");
  EXPECT_THROW(folder_.publish_model(learned, "alone.model"), Error);
  EXPECT_FALSE(fs::exists(files_.file("alone.model.cases.db"))) << "nothing is written beside it";
  EXPECT_EQ(read_file(files_.file("bench.model")), read_file(kSampleLogs + "golden/model-749d7413.json"));
}

TEST_F(JobsOfAFolder, JobsWithoutAReadableOutcomeRunWhenTheQueueStartsAndDamagedOnesCanBeRemoved) {
  new_job(1, "locked_1.csv");
  fs::create_directories(folder_.job_path(2));
  write_file(folder_.job_path(2) + "/request.json", "{");
  new_job(3, "healthy_1.csv");
  write_file(folder_.job_path(3) + "/outcome.json", "");
  QueueLimits limits;
  limits.process = process_;
  {
    JobQueue queue(folder_, limits);
    while (!queue.find(1)->has_ended() || !queue.find(3)->has_ended()) std::this_thread::yield();
    EXPECT_EQ(queue.find(2)->state(), JobState::failed);
    EXPECT_TRUE(queue.remove(2));
    EXPECT_EQ(queue.find(3)->outcome.verdict, "healthy");
  }
  EXPECT_EQ(read_job(folder_.job_path(1), 1).outcome.verdict, "faulty");
  EXPECT_FALSE(fs::exists(folder_.job_path(2)));
}

TEST_F(JobsOfAFolder, ANumberIsNotUsedTwice) {
  new_job(1, "locked_1.csv");
  folder_.remove_job(1);
  EXPECT_EQ(folder_.last_used_id(), 1);
  new_job(2, "locked_1.csv");
  EXPECT_EQ(folder_.last_used_id(), 2);
}

TEST_F(JobsOfAFolder, AMomentThatIsNoneIsDamage) {
  new_job(1, "locked_1.csv");
  std::string request = read_file(folder_.job_path(1) + "/request.json");
  request.replace(request.find("\"received_s\": 0"), 15, "\"received_s\": 1e300");
  write_file(folder_.job_path(1) + "/request.json", request);
  EXPECT_THROW(read_job(folder_.job_path(1), 1), Error);
}

TEST_F(JobsOfAFolder, AModelWithoutItsCaseBaseIsNamedAndItsNameIsTaken) {
  write_file(files_.file("old.model"), "a model");
  EXPECT_EQ(folder_.models_without_cases(), std::vector<std::string>{"old.model"});
  EXPECT_FALSE(folder_.has_model("old.model"));
  EXPECT_FALSE(folder_.is_free_name("old.model"));
}

TEST_F(JobsOfAFolder, AFullQueueIsRefused) {
  QueueLimits limits;
  limits.process = process_;
  limits.most_waiting = 0;
  JobQueue queue(folder_, limits);
  EXPECT_THROW(queue.add(folder_.new_incoming(), {JobKind::diagnose, "bench.model", {"a.csv"}, {}, 0}),
               Error);
}

TEST_F(JobsOfAFolder, AJobThatNeedsAMissingRunIsRefused) {
  QueueLimits limits;
  limits.process = process_;
  JobQueue queue(folder_, limits);
  EXPECT_THROW(queue.add(folder_.new_incoming(), {JobKind::compare, "bench.model", {}, {1, 2}, 0}), Error);
  EXPECT_TRUE(queue.all().empty());
}

TEST_F(JobsOfAFolder, TheConditionCountsALogThatWasDiagnosedTwiceOnce) {
  std::vector<Job> runs;
  for (std::int64_t id = 1; id <= 2; ++id) {
    Job job = new_job(id, "healthy_1.csv");
    job.outcome = run(job);
    runs.insert(runs.begin(), job);
  }
  ConditionView view(folder_);
  EXPECT_EQ(view.of(runs), "") << "one log is no course";
  Job other = new_job(3, "healthy_2.csv");
  other.outcome = run(other);
  runs.insert(runs.begin(), other);
  EXPECT_NE(view.of(runs), "");
  folder_.remove_job(3);
  EXPECT_NE(view.of(runs), "") << "what was read is remembered";
}

}  // namespace
}  // namespace faultline
