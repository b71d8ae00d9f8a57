// SPDX-License-Identifier: MIT
#include "formats/log_writer.hpp"

#include <filesystem>

#include "formats/log_formats.hpp"
#include "lib/core/error.hpp"
#include "lib/log/log.hpp"

namespace faultline {

std::vector<WrittenChannel> channels_of(const Log& log) {
  std::vector<WrittenChannel> channels{{"t", "", &log.time}};
  for_each_joint_channel(log, [&](const std::vector<double>& values, Channel channel) {
    channels.push_back({to_string(channel), "", &values});
  });
  for (const ExtraChannel& extra : log.extra)
    channels.push_back(
        {(canonical_channel(extra.name) ? "other_" : "") + extra.name, extra.unit, &extra.values});
  return channels;
}

std::unique_ptr<LogWriter> create_log(const std::string& path) {
  const std::vector<LogFormat> formats = written_formats();
  if (path == "-") return formats.front().create(path);
  const std::string extension = std::filesystem::path(path).extension().string();
  std::vector<std::string> choices;  // such as ".csv (text)"
  for (const LogFormat& format : formats) {
    if (extension == format.extensions.front()) return format.create(path);
    choices.push_back(format.extensions.front() + " (" + format.what + ")");
  }
  throw Error(ErrorCode::usage, path, "the extension decides the format of a log: use " + either_of(choices));
}

void write_log(const std::string& path, const Log& log) {
  const auto writer = create_log(path);
  writer->write(log);
  writer->commit();
}

}  // namespace faultline
