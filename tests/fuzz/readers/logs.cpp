// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "apps/inspection/inspection.hpp"
#include "formats/open_log.hpp"
#include "tests/fuzz/readers/feeding.hpp"
#include "tests/fuzz/readers/readers.hpp"

namespace faultline {
namespace {

/// Rows handed out.
std::int64_t read_through(LogSource& source) {
  std::int64_t rows = 0;
  double last = -std::numeric_limits<double>::infinity();
  Log segment;
  while (source.next(segment)) {
    demand(segment.first_row == rows, "segments follow each other");
    for (const double t : segment.time) {
      demand(std::isfinite(t) && t > last, "time is finite and increases");
      last = t;
    }
    rows += segment.rows();
  }
  demand(source.identity().rows_read == rows + source.issues().rows_dropped(), "every row is accounted for");
  for (const Issue& issue : source.issues().all())
    demand(issue.rows_dropped >= 0 && issue.count > 0, "issues count what there is");
  return rows;
}

/// Options under which a position is a field of the messages of a seed.
OpenLogOptions with_message_field() {
  constexpr const char *kTopic = "/arm/state", *kField = "feedback.positions[0]";
  ColumnSpec position;
  position.topic = kTopic;
  position.name = fmt::format("{}/{}", kTopic, kField);
  OpenLogOptions options;
  options.columns["q1"] = position;
  options.recording.fields = {{kTopic, kField}};
  return options;
}

}  // namespace

void feed_log(const std::string& bytes) {
  const std::string path = file_of("log", bytes);
  read_or_refuse([&] {
    const auto source = open_log(path, {.segment_rows = 100});
    const std::int64_t rows = read_through(*source);
    const Issues issues = source->issues();
    source->rewind();
    demand(read_through(*source) == rows, "a log that is read twice is the same");
    demand(source->issues().all().size() == issues.all().size(), "so are its issues");
  });
  read_or_refuse([&] { inspect_log(path, std::nullopt, {}); });
  read_or_refuse([&] { read_through(*open_log(path, with_message_field())); });
}

}  // namespace faultline
