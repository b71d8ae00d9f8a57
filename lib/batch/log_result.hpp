// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/batch/batch_folder.hpp"
#include "lib/batch/journal.hpp"
#include "lib/batch/run_batch.hpp"

namespace faultline {

/// The name in logs/ of the result of a log of this name and content: readable, without what a file name
/// should not hold, and different for different names or contents.
std::string result_name(const std::string& log_name, const std::string& log_sha256);

/// Of a log's name and content and of the settings (settings_of).
std::string result_key(const std::string& settings, const BatchLog& log, const std::string& log_sha256);

/// Whether the result files of an entry are there as they were written.
bool is_intact(const JournalEntry& entry, const BatchFolder& folder);

/// Diagnoses one log and writes its result files; the entry has neither key nor position yet.
/// Throws Error(input) when the log cannot be used and Error(output) when a file cannot be written.
JournalEntry write_log_result(const BatchLog& log, const std::string& log_sha256, const OpenLog& open,
                              const Model& model, const CaseBase& cases, const BatchFolder& folder,
                              const BatchOptions& options);

}  // namespace faultline
