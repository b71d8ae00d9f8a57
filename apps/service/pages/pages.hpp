// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/service/job.hpp"
#include "apps/service/pages/page_frame.hpp"

// The pages of faultline serve; each is a function from values to HTML.
namespace faultline {

/// A robot of the service with its diagnoses.
struct ServedRobot {
  std::string model;
  std::vector<Job> runs;  ///< its diagnoses, the latest first
};

/// The form that takes logs to diagnose; with one robot there is nothing to choose.
std::string drop_form(const PageContext& context, const std::vector<std::string>& models);
/// A table of jobs with state, result and time; `with_robot` adds a column.
std::string job_table(const std::vector<Job>& jobs, bool with_robot);

/// All robots and the latest jobs. `without_cases` are files that look like models and have no case base.
std::string home_page(const PageContext& context, const std::vector<ServedRobot>& robots,
                      const std::vector<std::string>& without_cases, const std::vector<Job>& latest);

/// One robot: its runs, its condition over time (HTML, may be empty), two runs to compare.
std::string robot_page(const PageContext& context, const ServedRobot& robot, const std::string& condition,
                       std::size_t page);
inline constexpr std::size_t kRunsPerPage = 50;

/// A statement of a user about a fault of a run, as stored in the case base.
struct StatedCase {
  int fault_id = 0;
  std::string text;
};

/// What the page of a job shows of its files.
struct JobFiles {
  std::string report{};      ///< the diagnosis as JSON; empty if there is none
  std::string answer{};      ///< standard output of the command
  std::string robot_file{};  ///< the suggested robot file
  std::vector<StatedCase> stated{};
  std::vector<Job> recordings{};  ///< jobs that make, or made, the recording of this run
  std::size_t before = 0;         ///< jobs that wait before this one
};

/// One job: its progress, or its result with what can be done next.
std::string job_page(const PageContext& context, const Job& job, const JobFiles& files);
/// State of a job in a sentence, such as "Running: 42 %, reading run.csv".
std::string progress_sentence(const Job& job, std::size_t before);

/// The form that takes healthy logs of a new robot.
std::string learn_page(const PageContext& context);

/// The form that takes the token; `sentence` says why an earlier one was refused, or is empty.
std::string login_page(const std::string& sentence);

}  // namespace faultline
