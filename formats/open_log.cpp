// SPDX-License-Identifier: MIT
#include "formats/open_log.hpp"

#include <array>
#include <string_view>

#include "formats/byte_source.hpp"
#include "formats/csv_reader.hpp"
#include "formats/native_reader.hpp"
#include "lib/core/error.hpp"
#include "lib/log/mapped_source.hpp"

namespace faultline {
namespace {

/// One row a format. `matches` judges the first bytes of a file; CSV comes last and takes any text.
struct Format {
  const char* name;
  std::vector<std::string> extensions;
  bool (*matches)(std::string_view head);
  std::unique_ptr<RawReader> (*open)(std::unique_ptr<ByteSource> bytes);
};

const std::vector<Format>& formats() {
  static const std::vector<Format> table{
      {"native", {".flog"}, looks_like_native, open_native},
      {"csv", {".csv", ".txt", ".tsv", ".dat"}, looks_like_csv, open_csv},
  };
  return table;
}

}  // namespace

std::unique_ptr<RawReader> open_raw(const std::string& path) {
  auto bytes = std::make_unique<ByteSource>(path);
  if (bytes->head().empty())
    throw Error(ErrorCode::input, path, "is empty; a log has a header and at least one row");
  for (const Format& format : formats())
    if (format.matches(bytes->head())) return format.open(std::move(bytes));
  throw Error(ErrorCode::input, path,
              "is of no known format: it is binary, but no faultline log (.flog). Export it as CSV in UTF-8");
}

std::unique_ptr<LogSource> open_log(const std::string& path, const OpenLogOptions& options) {
  return std::make_unique<MappedSource>(
      open_raw(path), MappedSourceOptions{options.columns, options.segment_rows, options.keep_extra});
}

std::vector<FormatInfo> log_formats() {
  std::vector<FormatInfo> infos;
  for (const Format& format : formats()) infos.push_back({format.name, format.extensions});
  return infos;
}

}  // namespace faultline
