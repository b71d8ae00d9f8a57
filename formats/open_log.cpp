// SPDX-License-Identifier: MIT
#include "formats/open_log.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/known_formats.hpp"
#include "formats/log_formats.hpp"
#include "lib/core/error.hpp"
#include "lib/log/mapped_source.hpp"
#include "lib/log/recorder/corrected_source.hpp"

namespace faultline {
namespace {

/// A format that other programs convert, by its first bytes.
struct ForeignFormat {
  std::string_view magic;
  const char* what;  ///< a sentence on what the file is and how to convert it, without its subject
};

constexpr ForeignFormat kForeignFormats[] = {
    {"PAR1",
     "is a Parquet file, which cannot be read directly; convert it, in Python with "
     "pandas.read_parquet(\"run.parquet\").to_csv(\"run.csv\", index=False)"},
    {"ARROW1",
     "is a Feather (Arrow) file, which cannot be read directly; convert it, in Python with "
     "pandas.read_feather(\"run.feather\").to_csv(\"run.csv\", index=False)"},
    {"TDSm",
     "is a TDMS file, which cannot be read directly; convert it, in Python with npTDMS: "
     "nptdms.TdmsFile.read(\"run.tdms\").as_dataframe(time_index=True).to_csv(\"run.csv\", index_label=\"time\")"},
    {"MDF     ",
     "is an MDF file, which cannot be read directly; convert it, in Python with asammdf: "
     "asammdf.MDF(\"run.mf4\").to_dataframe(raster=0.001).to_csv(\"run.csv\", index_label=\"time\"), where raster is "
     "the sample period in s"},
    {"UnFinMF ",
     "is an MDF file that its recorder did not finish, which cannot be read directly; convert it, in Python with "
     "asammdf: asammdf.MDF(\"run.mf4\").to_dataframe(raster=0.001).to_csv(\"run.csv\", index_label=\"time\"), where "
     "raster is the sample period in s"},
    {"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1",
     "is an Excel workbook of the format before 2007, or another Office document; save the sheet with the log as CSV "
     "in UTF-8, or convert it: libreoffice --headless --convert-to csv run.xls"},
    {"\xFF\xFE", "holds text in UTF-16 inside another compression; unpack it first"},
    {"\xFE\xFF", "holds text in UTF-16 inside another compression; unpack it first"},
};

/// Bytes that show whether a text is UTF-16 without its byte-order mark.
constexpr std::size_t kEncodingBytes = 64;

/// Returns "UTF-16LE" or "UTF-16BE" for a text of ASCII characters in that encoding; null for any other.
const char* utf16_without_mark(std::string_view head) {
  head = head.substr(0, kEncodingBytes);
  for (const std::size_t high : {std::size_t{1}, std::size_t{0}}) {
    bool is_text = head.size() > 3;
    for (std::size_t i = 0; i < head.size(); ++i) is_text = is_text && (head[i] == '\0') == (i % 2 == high);
    if (is_text) return high == 1 ? "UTF-16LE" : "UTF-16BE";
  }
  return nullptr;
}

/// Throws Error(input) with the way out for a file that no reader reads.
[[noreturn]] void refuse_foreign(const std::string& path, std::string_view head) {
  for (const ForeignFormat& format : kForeignFormats)
    if (head.starts_with(format.magic)) throw Error(ErrorCode::input, path, format.what);
  if (const char* encoding = utf16_without_mark(head))
    throw Error(
        ErrorCode::input, path,
        fmt::format("is text in UTF-16 without a byte-order mark; convert it: iconv -f {} -t UTF-8 run.csv > "
                    "run_utf8.csv",
                    encoding));
  throw Error(ErrorCode::input, path,
              "has an unknown format: it is binary, but not " + either_of(log_extensions()) +
                  ". Export it as CSV in UTF-8");
}

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
  refuse_foreign(path, bytes->head());
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
  return mended(std::make_unique<MappedSource>(open_parts(path, options.parts, options.recording),
                                               MappedSourceOptions{options.columns, options.parts.run,
                                                                   options.segment_rows, options.keep_extra}),
                options.slides);
}

std::vector<std::string> files_beside(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  try {
    ByteSource bytes(path, false);
    return looks_like_diadem(bytes.head()) ? files_beside_diadem(bytes) : std::vector<std::string>{};
  } catch (const Error&) {
    return {};  // whoever reads the log reports it
  }
}

}  // namespace faultline
