// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "lib/cases/sqlite.hpp"

namespace faultline {

/// The tables of a case base file (docs/model-and-case-base.md). Version 1 has no table `identity` and no
/// columns of the log of a case; version 2 has no columns of the robot and of the person who gave a label.
inline constexpr std::int64_t kCaseSchemaVersion = 3;

/// Creates the tables of the newest version, empty.
void create_case_tables(SqliteFile& file);
/// Removes all tables of version `version`.
void drop_case_tables(SqliteFile& file, std::int64_t version);

/// Returns the version of a file whose application id, version and schema are exactly those of a case base,
/// without any other table, view, index or trigger. Throws Error(input) with `name` for other files.
std::int64_t checked_case_schema(SqliteFile& file, const std::string& name);

/// SHA-256 of every value with its type in all tables of a version from 2 on, without the digest itself.
std::string case_tables_digest(SqliteFile& file, std::int64_t version = kCaseSchemaVersion);

}  // namespace faultline
