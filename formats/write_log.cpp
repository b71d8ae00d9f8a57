// SPDX-License-Identifier: MIT
#include "formats/write_log.hpp"

#include <filesystem>

#include "formats/csv_writer.hpp"
#include "formats/native_writer.hpp"
#include "lib/core/error.hpp"

namespace faultline {

std::unique_ptr<LogWriter> create_log(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (path == "-" || extension == ".csv") return create_csv(path);
  if (extension == ".flog") return create_native(path);
  throw Error(ErrorCode::usage, path,
              "the extension decides the format of a log: use .csv (text) or .flog (binary, exact, fast)");
}

void write_log(const std::string& path, const Log& log) {
  const auto writer = create_log(path);
  writer->write(log);
  writer->commit();
}

}  // namespace faultline
