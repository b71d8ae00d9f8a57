// SPDX-License-Identifier: MIT
#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "formats/known_formats.hpp"
#include "formats/log_writer.hpp"
#include "formats/provenance.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/csv_cell.hpp"

namespace faultline {
namespace {

std::string quoted_when_needed(const std::string& text) {
  const std::string name = inert_text(text);
  if (name.find_first_of(",;\"|# ") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' ? '\'' : c;
  return quoted + "\"";
}

class CsvWriter : public LogWriter {
 public:
  explicit CsvWriter(const std::string& path) : file_(path) {}

  void write(const Log& segment) override {
    const auto channels = channels_of(segment);
    text_.clear();
    if (!header_written_) write_header(channels);
    for (int row = 0; row < segment.rows(); ++row) {
      for (std::size_t c = 0; c < channels.size(); ++c) {
        if (c > 0) text_.push_back(',');
        const double value = (*channels[c].values)[row];
        if (!std::isnan(value)) fmt::format_to(std::back_inserter(text_), FMT_COMPILE("{}"), value);
      }
      text_.push_back('\n');
    }
    file_.write({text_.data(), text_.size()});
  }

  void note_provenance(const std::string& provenance) override {
    file_.write(std::string(kProvenanceComment) + provenance + "\n");
  }

  void commit() override { file_.commit(); }

 private:
  void write_header(const std::vector<WrittenChannel>& channels) {
    for (const WrittenChannel& channel : channels) {
      const std::string name = channel.unit.empty() ? channel.name : channel.name + " [" + channel.unit + "]";
      if (&channel != &channels.front()) text_.push_back(',');
      text_.append(quoted_when_needed(name));
    }
    text_.push_back('\n');
    header_written_ = true;
  }

  AtomicFile file_;
  fmt::memory_buffer text_;
  bool header_written_ = false;
};

}  // namespace

std::unique_ptr<LogWriter> create_csv(const std::string& path) { return std::make_unique<CsvWriter>(path); }

}  // namespace faultline
