// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lib/cases/case_base.hpp"
#include "lib/cases/sqlite.hpp"

namespace faultline {

/// What the tables of a case base of this version hold; that they are whole and fit is not checked.
Metric metric_in_tables(SqliteFile& file);
std::vector<Case> cases_in_tables(SqliteFile& file, std::int64_t version);

/// Fills empty tables of the newest version.
void fill_tables(SqliteFile& file, const CaseBase& base);

}  // namespace faultline
