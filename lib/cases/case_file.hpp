// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "lib/cases/case_base.hpp"

namespace faultline {

/// Where the case base of a model lies unless the user says otherwise: MODEL.cases.db beside it.
std::string case_base_path(const std::string& model);

/// The case base as one SQLite file: application id "FLCB", schema version 1 (docs/model-and-case-base.md).
/// All functions throw Error(input) that says what is wrong with the file: missing, a directory, empty,
/// truncated, damaged, written by another program or by a newer faultline.

/// Opens the file read-only: it is never changed, not even its time stamp.
CaseBase read_case_base(const std::string& path);

/// Writes the whole base under a temporary name and renames it; a file of that name is replaced.
/// Throws Error(output) when that fails.
void write_case_base(const std::string& path, const CaseBase& base);

/// Reads the base, lets `change` work on it and stores what it changed, as one transaction: all of it or,
/// when `change` throws or the disk is full, nothing. Others may read meanwhile; a second writer waits.
void change_case_base(const std::string& path, const std::function<void(CaseBase&)>& change);

}  // namespace faultline
