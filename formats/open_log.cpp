// SPDX-License-Identifier: MIT
#include "formats/open_log.hpp"

#include <string_view>
#include <utility>
#include <vector>

#include "formats/log_formats.hpp"
#include "lib/core/error.hpp"
#include "lib/log/mapped_source.hpp"
#include "lib/log/recorder/corrected_source.hpp"

namespace faultline {
namespace {

constexpr std::string_view kParquetMagic = "PAR1";

}  // namespace

std::unique_ptr<RawReader> open_raw(const std::string& path, bool hashed, const RecordingChoice& choice) {
  auto bytes = std::make_unique<ByteSource>(path, hashed);
  if (bytes->head().empty())
    throw Error(ErrorCode::input, path, "is empty; a log has a header and at least one row");
  for (const LogFormat& format : log_formats())
    if (format.matches(bytes->head())) {
      auto reader = format.open(std::move(bytes));
      reader->choose(choice);
      return reader;
    }
  if (bytes->head().starts_with(kParquetMagic))
    throw Error(ErrorCode::input, path,
                "is a Parquet file, which cannot be read directly; convert it, in Python with "
                "pandas.read_parquet(\"run.parquet\").to_csv(\"run.csv\", index=False)");
  throw Error(ErrorCode::input, path,
              "has an unknown format: it is binary, but not " + either_of(log_extensions()) +
                  ". Export it as CSV in UTF-8");
}

std::unique_ptr<RawReader> open_parts(const std::string& path, const LogSelection& parts,
                                      const RecordingChoice& choice) {
  // The hash of a log of several files is computed from the hashes of all files.
  const bool all_hashed = parts.hashed || !parts.then.empty() || !parts.join.empty();
  auto first = open_raw(path, all_hashed, choice);
  if (!parts.then.empty()) {
    std::vector<std::unique_ptr<RawReader>> files;
    files.push_back(std::move(first));
    for (const std::string& file : parts.then) files.push_back(open_raw(file, all_hashed, choice));
    first = continue_files(std::move(files));
  }
  if (parts.join.empty()) return first;
  std::vector<std::unique_ptr<RawReader>> others;
  for (const std::string& file : parts.join) others.push_back(open_raw(file));
  return join_files(std::move(first), std::move(others), parts.by);
}

std::unique_ptr<LogSource> open_log(const std::string& path, const OpenLogOptions& options) {
  return mended(std::make_unique<MappedSource>(
      open_parts(path, options.parts, options.recording),
      MappedSourceOptions{options.columns, options.parts.run, options.segment_rows, options.keep_extra}));
}

}  // namespace faultline
