// SPDX-License-Identifier: MIT
#include "formats/csv/later_header.hpp"

#include <algorithm>
#include <string>

#include "formats/csv/csv_fields.hpp"
#include "lib/log/units.hpp"

namespace faultline {
namespace {

/// The field that names the column; -1 for none.
int field_of(const RawColumn& column, bool unit_stood_there, const std::vector<NameAndUnit>& names) {
  for (std::size_t f = 0; f < names.size(); ++f)
    if (names[f].name == column.name && (!unit_stood_there || names[f].unit == column.unit))
      return static_cast<int>(f);
  return -1;
}

}  // namespace

std::optional<LaterHeader> find_later_header(const CsvDialect& dialect,
                                             const std::vector<std::string_view>& fields) {
  if (!dialect.has_header || dialect.columns.size() < 2) return {};
  std::vector<NameAndUnit> names;
  for (const std::string_view field : fields) {
    const CellKind kind = read_cell(field, dialect.decimal).kind;
    if (kind == CellKind::number) return {};
    names.push_back(split_unit(std::string(field)));
  }
  const bool has_units =
      std::any_of(names.begin(), names.end(), [](const NameAndUnit& name) { return !name.unit.empty(); });
  LaterHeader header;
  for (const RawColumn& column : dialect.columns) header.fields.push_back(field_of(column, has_units, names));
  const auto lacking = std::count(header.fields.begin(), header.fields.end(), -1);
  if (2 * lacking > static_cast<std::ptrdiff_t>(header.fields.size())) return {};
  header.has_all = lacking == 0 && static_cast<int>(fields.size()) == dialect.fields;
  return header;
}

}  // namespace faultline
