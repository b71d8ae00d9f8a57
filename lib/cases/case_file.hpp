// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lib/cases/case_base.hpp"

namespace faultline {

/// Default path of the case base of a model: MODEL.cases.db beside it.
std::string case_base_path(const std::string& model);

/// The case base as one SQLite file: application id "FLCB", schema version 3 (docs/model-and-case-base.md).
/// All functions throw Error(input) with the defect of the file: missing, a directory or device, empty,
/// truncated, damaged (its digest does not fit), with tables of its own, of another program or another schema
/// version.

/// Opens the file read-only, without changing even its time stamp. Undoes an interrupted change in a copy, so
/// that no write permission is needed.
CaseBase read_case_base(const std::string& path);

/// Whether the path exists and is not an empty file.
bool has_case_base(const std::string& path);

/// Replaces the content of a case base file, without reading its cases, in one transaction; writes a new file
/// if there is none. Throws Error(output) if that fails; then the file is unchanged.
void write_case_base(const std::string& path, const CaseBase& base);

/// Writes the base that `make` returns for the present base, which is read under the lock of the transaction;
/// null if there is none.
void replace_case_base(const std::string& path, const std::function<CaseBase(const CaseBase* there)>& make);

/// Reads the base, applies `change` and stores the result in one transaction: completely or, if `change`
/// throws or the disk is full, not at all. Other programs may read meanwhile; a second writer waits.
void change_case_base(const std::string& path, const std::function<void(CaseBase&)>& change);

/// Returns one case with its features by name; NaN is null.
nlohmann::ordered_json to_json(const CaseBase& base, const Case& c);

/// Returns the whole base as JSON text, schema "faultline/cases/1", without loss: from_cases_json() returns a
/// base with the same sha256.
std::string to_cases_json(const CaseBase& base);
/// Throws Error(input) with `where` and the position in the text.
CaseBase from_cases_json(const std::string& text, const std::string& where);

}  // namespace faultline
