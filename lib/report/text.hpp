// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"

namespace faultline {

struct TimelineOptions {
  int width = 80;       ///< characters, at least 40
  bool unicode = true;  ///< line-drawing characters, else ASCII
  bool color = false;
};

/// A bar over the run for each joint (and one for the robot when a fault belongs to no joint), a time axis
/// and a legend. The digit is the fault's number at its onset, "!" its alarm; marks that fall on the same
/// place stand side by side. Empty when the log has no span of time.
std::string render_timeline(const Diagnosis& diagnosis, const TimelineOptions& options = {});

/// The report a technician reads in a terminal: verdict, timeline over the run, a block a fault, residuals of
/// the regenerated motion, issues of the log, what cannot be seen.
std::string render_text(const Diagnosis& diagnosis, const TimelineOptions& options = {});

/// The verdict in one sentence, such as "1 fault: joint 2 is locked, from 4.210 s."
std::string verdict_sentence(const Diagnosis& diagnosis);

/// The diagnosis for an issue tracker or a merge request, in the Markdown of GitHub and GitLab: verdict, a
/// table of the faults, what to check next, what was wrong with the log, hashes. Texts from outside cannot
/// become markup, mentions or links.
std::string render_markdown(const Diagnosis& diagnosis);

/// Schema "faultline/diagnosis/1" (docs/report.md): two-space indented, keys always all there and in the same
/// order, NaN as null, text as valid UTF-8. The same Diagnosis gives the same bytes.
std::string render_json(const Diagnosis& diagnosis);

/// One row a fault under a header that is always there, so that rows of several logs can be put together. The
/// first columns are those of a labels file (file,fault,joint,onset_s,end_s). A log without faults gives one
/// row with fault "none" when it is healthy and no row when it is inconclusive. RFC 4180 quoting; NaN is
/// empty; a number is the shortest text that reads back the same.
std::string render_csv(const Diagnosis& diagnosis);

/// A test case of a JUnit report; an empty `body` (XML) passed.
struct JunitCase {
  std::string name;
  std::string body;
};

/// JUnit XML of one suite. A body holds elements "failure", "error" or "skipped"; failures are counted, and
/// the others if the name of their count (errors, skipped) is in `counts`.
std::string junit_suite(const std::string& suite, const std::vector<JunitCase>& cases,
                        const std::vector<std::string>& counts);

/// JUnit XML for continuous-integration servers: the log is a suite, each joint a test case that fails with
/// the faults found on it; faults of no joint fail a case "robot"; an inconclusive log is one skipped case.
std::string render_junit(const Diagnosis& diagnosis);

}  // namespace faultline
