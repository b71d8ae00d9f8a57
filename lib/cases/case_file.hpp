// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "lib/cases/case_base.hpp"

namespace faultline {

/// Where the case base of a model lies unless the user says otherwise: MODEL.cases.db beside it.
std::string case_base_path(const std::string& model);

/// The case base as one SQLite file: application id "FLCB", schema version 3 (docs/model-and-case-base.md);
/// versions 1 and 2 are read, too, and become version 3 when they are changed. All functions throw
/// Error(input) that says what is wrong with the file: missing, a directory or device, empty, truncated,
/// damaged (its digest does not fit), with tables of its own, written by another program or by a newer
/// faultline.

/// Opens the file read-only: it is never changed, not even its time stamp. A change that was interrupted is
/// undone in a copy, so that who may only read can read.
CaseBase read_case_base(const std::string& path);

/// True when there is a file that is not empty.
bool has_case_base(const std::string& path);

/// Makes `base` the content of the file, as one transaction in a case base that is there (whatever it holds),
/// else as a new file. Throws Error(output) when that fails; then the file is as it was.
void write_case_base(const std::string& path, const CaseBase& base);

/// The same with what `make` makes of the base that is there, read under the lock of the transaction; null
/// when there is none.
void replace_case_base(const std::string& path, const std::function<CaseBase(const CaseBase* there)>& make);

/// Reads the base, lets `change` work on it and stores what it changed, as one transaction: all of it or,
/// when `change` throws or the disk is full, nothing. Others may read meanwhile; a second writer waits.
void change_case_base(const std::string& path, const std::function<void(CaseBase&)>& change);

}  // namespace faultline
