// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace faultline {

/// Name of the text that is stored beside the arrays of a written log.
inline constexpr const char* kNotesName = "faultline";

/// An extra channel of a written log with its original name and unit.
struct NotedChannel {
  std::string array;  ///< its name in the file
  std::string name;
  std::string unit;
};

/// The content of a log that arrays alone cannot store.
struct ArrayNotes {
  std::vector<NotedChannel> extra;
  std::string provenance;  ///< as passed to LogWriter::note_provenance()
};

/// Returns one line of JSON, schema "faultline/arrays/1", in ASCII.
std::string notes_text(const ArrayNotes& notes);
/// Parses notes_text(); nullopt when the text is not valid.
std::optional<ArrayNotes> read_notes(std::string_view text);

}  // namespace faultline
