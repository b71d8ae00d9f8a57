// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "formats/byte_source.hpp"
#include "formats/log_writer.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// A format of log files; each has a row in the table of log_formats.cpp.
struct LogFormat {
  const char* name;
  const char* what;  ///< a description for the user who must choose one
  /// Usual extensions of its files that no other format has; a log is written under the first one.
  std::vector<std::string> extensions;
  /// True when a file that begins like this, with up to 64 KiB, is of this format.
  bool (*matches)(std::string_view head);
  std::unique_ptr<RawReader> (*open)(std::unique_ptr<ByteSource> bytes);
  /// Null for formats that are only read.
  std::unique_ptr<LogWriter> (*create)(const std::string& path);
};

/// Returns the formats in the order in which a file is tested.
const std::vector<LogFormat>& log_formats();

/// Returns the extensions of all formats that are read.
std::vector<std::string> log_extensions();

/// Returns the endings of log names: the extensions, plain and before that of a compressed file (".csv.gz").
std::vector<std::string> log_name_endings();

/// Returns the formats in which a log can be written, the most general (CSV) first.
std::vector<LogFormat> written_formats();

/// Returns "a", "a or b", "a, b or c".
std::string either_of(const std::vector<std::string>& choices);

}  // namespace faultline
