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
  const char* what;  ///< to somebody who must choose one
  /// Usual ones of files in it; a log is written in it under the first one.
  std::vector<std::string> extensions;
  /// Whether a file that begins like this, with up to 64 KiB, is of this format.
  bool (*matches)(std::string_view head);
  std::unique_ptr<RawReader> (*open)(std::unique_ptr<ByteSource> bytes);
  /// Null when the format is only read.
  std::unique_ptr<LogWriter> (*create)(const std::string& path);
};

/// In the order in which a file is tried.
const std::vector<LogFormat>& log_formats();

/// Of all formats that are read.
std::vector<std::string> log_extensions();

/// How names of logs end: the extensions, also before that of a packed file (".csv.gz").
std::vector<std::string> log_name_endings();

/// Those that a log can be written in, the most general (CSV) first.
std::vector<LogFormat> written_formats();

/// "a", "a or b", "a, b or c".
std::string either_of(const std::vector<std::string>& choices);

}  // namespace faultline
