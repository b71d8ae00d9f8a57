// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/golden/golden_set.hpp"
#include "lib/golden/replay.hpp"

namespace faultline {

/// A folder of golden logs: golden.toml, and beside it the logs, the traces, the model and its case base.
/// Traces, model and case base carry a part of their hash in their name, so that a new golden.toml is the one
/// step that changes what is expected.
std::string golden_file(const std::string& folder);

/// Reads golden.toml and the traces. A log or trace that is missing or has another content is damage of its
/// log; everything else that is wrong throws Error(input).
GoldenSet load_golden(const std::string& folder);

/// The model and case base of the folder. Throws Error(input) when they are not those that were recorded.
ModelAndCases load_golden_model(const std::string& folder, const GoldenSet& set);
ModelAndCases load_model_and_cases(const std::string& model, const std::string& cases);

std::vector<ReplayLog> replay_logs(const std::string& folder, const GoldenSet& set);

/// Writes the traces of `run`'s logs that `set` names (setting their hash), then golden.toml, then removes
/// files that the set named before and names no more. What `set` says besides is written as it is.
void save_golden(const std::string& folder, GoldenSet& set, const std::vector<std::string>& outdated = {});

/// Removes traces, models and case bases under names of their content that `set` does not name, which an
/// interrupted accept_golden() left there.
void remove_orphaned_files(const std::string& folder, const GoldenSet& set);

/// Writes a copy of the model file and its case base into the folder, under names of their content, and
/// returns the set that names them.
GoldenSet adopt_model(const std::string& folder, const std::string& model, const ModelAndCases& subject,
                      GoldenSet set);

}  // namespace faultline
