// SPDX-License-Identifier: MIT
#include "apps/work/conversion.hpp"

#include <memory>

#include "formats/provenance.hpp"
#include "lib/core/error.hpp"

namespace faultline {

Conversion convert_log(LogSource& log, const std::string& out,
                       const std::optional<std::vector<LogEvent>>& events, const Progress& progress) {
  const std::unique_ptr<LogWriter> writer = create_log(out);
  Log segment;
  while (log.next(segment)) {
    writer->write(segment);
    if (progress) progress("converting " + log.identity().path, log.share_read());
  }
  if (events && !writer->note_events(*events))
    throw Error(ErrorCode::usage, out, "cannot hold the events of a diagnosis; only a .mcap can");
  const std::string provenance = provenance_of(log);
  if (!provenance.empty()) writer->note_provenance(provenance);
  writer->commit();
  const std::int64_t rows = log.identity().rows_read;
  return {rows, rows - log.issues().rows_dropped(), log.issues(), !provenance.empty()};
}

}  // namespace faultline
