// SPDX-License-Identifier: MIT
#include "formats/open_log.hpp"

#include "formats/log_formats.hpp"
#include "lib/core/error.hpp"
#include "lib/log/mapped_source.hpp"

namespace faultline {

std::unique_ptr<RawReader> open_raw(const std::string& path) {
  auto bytes = std::make_unique<ByteSource>(path);
  if (bytes->head().empty())
    throw Error(ErrorCode::input, path, "is empty; a log has a header and at least one row");
  for (const LogFormat& format : log_formats())
    if (format.matches(bytes->head())) return format.open(std::move(bytes));
  throw Error(ErrorCode::input, path,
              "is of no known format: it is binary, but no faultline log (.flog). Export it as CSV in UTF-8");
}

std::unique_ptr<LogSource> open_log(const std::string& path, const OpenLogOptions& options) {
  return std::make_unique<MappedSource>(
      open_raw(path),
      MappedSourceOptions{options.columns, options.recording, options.segment_rows, options.keep_extra});
}

}  // namespace faultline
