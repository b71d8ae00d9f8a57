// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/golden/comparison.hpp"
#include "lib/golden/golden_set.hpp"

namespace faultline {

/// One log, or the identification, compared.
struct CheckedItem {
  std::string name;
  std::string damage;  ///< its golden files are not as recorded; then nothing is compared
  std::string verdict_expected, verdict_actual;
  int events_expected = 0, events_actual = 0;
  Comparison comparison;

  bool same() const { return damage.empty() && comparison.same(); }
  bool changes_verdict() const { return comparison.changes_verdict(); }
};

/// Two runs over one golden folder, or one run and what is expected.
struct GoldenCheck {
  std::string expected_by, actual_by;  ///< who says so, for the headings
  std::vector<CheckedItem> items;      ///< logs in their order, then the identification and the model

  bool same() const;
  bool damaged() const;
};

/// What is expected against `run`.
GoldenCheck check_golden(const GoldenSet& set, const GoldenRun& run);
/// One run against another, with the tolerances of the folder. Throws Error(input) when a run is not of the
/// folder's logs.
GoldenCheck compare_runs(const GoldenSet& set, const GoldenRun& first, const GoldenRun& second);

/// The set with what `run` says of the item of that name (a log, "identification" or "model"). Tolerances
/// stay.
GoldenSet with_actual(GoldenSet set, const GoldenRun& run, const std::string& name);

/// A table of all items, then of each that differs its first divergence and a unified difference.
std::string render_check_text(const GoldenCheck& check, bool color = false);

/// JUnit XML: a test case for each log and for the identification. A mismatch is a failure whose message is
/// the first divergence, a damaged golden file an error.
std::string render_check_junit(const GoldenCheck& check, const std::string& suite);

/// Schema "faultline/golden-check/1" (docs/golden.md): the differences, and all that the run says, so that
/// golden compare can set it against a run of another program version. NaN is null.
std::string render_check_json(const GoldenCheck& check, const GoldenRun& run);

/// The run out of such a text. Throws Error(input) for text that is none.
GoldenRun run_from_json(const std::string& text, const std::string& where);

}  // namespace faultline
