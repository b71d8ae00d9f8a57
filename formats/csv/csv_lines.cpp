// SPDX-License-Identifier: MIT
#include "formats/csv/csv_lines.hpp"

#include <map>

#include "formats/csv/csv_fields.hpp"

namespace faultline {
namespace {

constexpr std::size_t kSampleLines = 300;

}  // namespace

std::vector<CsvLine> lines_of(std::string_view head) {
  std::vector<CsvLine> lines;
  std::size_t begin = head.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;
  while (begin < head.size() && lines.size() < kSampleLines) {
    const auto newline = head.find('\n', begin);
    const std::size_t end = newline == std::string_view::npos ? head.size() : newline + 1;
    CsvLine line{begin, end, head.substr(begin, (newline == std::string_view::npos ? end : newline) - begin)};
    line.comment = is_comment_or_blank(line.text);
    lines.push_back(line);
    begin = end;
  }
  const bool cut = lines.size() > 2 && lines.back().end == head.size() && head.back() != '\n';
  if (cut) lines.pop_back();
  return lines;
}

void count_cells(CsvLine& line, char separator, char decimal) {
  split_fields(line.text, separator, line.fields);
  line.numbers = line.texts = 0;
  for (const std::string_view field : line.fields) {
    const CellKind kind = read_cell(field, decimal).kind;
    line.numbers += kind == CellKind::number;
    line.texts += kind == CellKind::text;
  }
}

int usual_fields(const std::vector<CsvLine>& lines) {
  std::map<int, int> frequency;
  for (const CsvLine& line : lines)
    if (!line.comment) ++frequency[static_cast<int>(line.fields.size())];
  int best = 0, count = 0;
  for (const auto& [fields, times] : frequency)
    if (times >= count) best = fields, count = times;
  return best;
}

bool is_data(const CsvLine& line, int fields) {
  return !line.comment && static_cast<int>(line.fields.size()) == fields && line.numbers > 0 &&
         2 * line.numbers >= line.texts;
}

}  // namespace faultline
