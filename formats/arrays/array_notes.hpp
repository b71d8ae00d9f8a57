// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace faultline {

/// Name of the text that a log written as arrays has beside them.
inline constexpr const char* kNotesName = "faultline";

/// An extra channel of a written log, exactly as it was.
struct NotedChannel {
  std::string array;  ///< its name in the file
  std::string name;
  std::string unit;
};

/// What arrays alone cannot tell of a log.
struct ArrayNotes {
  std::vector<NotedChannel> extra;
  std::string provenance;  ///< as LogWriter::note_provenance() gets it
};

/// One line of JSON, schema "faultline/arrays/1", in ASCII.
std::string notes_text(const ArrayNotes& notes);
/// Nullopt when it cannot be read.
std::optional<ArrayNotes> read_notes(std::string_view text);

}  // namespace faultline
