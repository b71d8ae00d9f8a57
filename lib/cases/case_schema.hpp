// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "lib/cases/sqlite.hpp"

namespace faultline {

/// Version of the tables of a case base file (docs/model-and-case-base.md).
inline constexpr std::int64_t kCaseSchemaVersion = 3;

void create_case_tables(SqliteFile& file);
void drop_case_tables(SqliteFile& file);

/// Throws Error(input) with `name` unless application id, version and schema of the file are exactly those of
/// a case base, without any other table, view, index or trigger.
void check_case_schema(SqliteFile& file, const std::string& name);

/// SHA-256 of every value with its type in all tables, without the digest itself.
std::string case_tables_digest(SqliteFile& file);

}  // namespace faultline
