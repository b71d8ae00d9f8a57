// SPDX-License-Identifier: MIT
#include "formats/diadem/diadem_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

/// Longest line of a header, bytes; those of recorders have some tens.
constexpr std::size_t kLongestDiademLine = 1 << 16;
/// Upper limit of the channels of a header, as of the columns of any table.
constexpr std::size_t kMostDiademChannels = 1 << 14;
/// Upper limit of counts and places, values: a file of some TB.
constexpr double kMostDiademValues = 1e12;
/// Least magnitude of a number that stands for a missing value; DIAdem's is 9.9e34. A smaller one could be a
/// measurement.
constexpr double kLeastMissingMark = 1e10;

/// Meaning of a line by the number at its beginning.
enum DiademKey {
  kMissingMark = 111,
  kByteOrder = 112,
  kChannelName = 200,
  kChannelUnit = 202,
  kChannelKind = 210,
  kDataFile = 211,
  kStorage = 213,
  kValueType = 214,
  kValueCount = 220,
  kFirstValue = 221,
  kBlockWidth = 222,
  kStartValue = 240,
  kStepWidth = 241
};

struct DiademTypeName {
  const char* name;
  DiademType type;
  std::size_t bytes;
};

/// In the order of DiademType.
constexpr DiademTypeName kDiademTypes[] = {{"REAL64", DiademType::real64, 8},
                                           {"REAL32", DiademType::real32, 4},
                                           {"INT16", DiademType::int16, 2},
                                           {"INT32", DiademType::int32, 4}};

std::string_view stripped_line(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\0' || c == '\x1a'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return capitals;
}

/// Returns the text as UTF-8: controllers write Latin-1.
std::string as_utf8(std::string_view text) {
  if (valid_utf8(text) == text) return std::string(text);
  constexpr unsigned char kFirstLatin = 0xa0, kFirstContinued = 0xc0;  // as bytes of Latin-1
  std::string utf8;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80)
      utf8 += c;
    else if (byte < kFirstLatin)
      utf8 += '?';
    else
      (utf8 += byte < kFirstContinued ? '\xc2' : '\xc3') += static_cast<char>(0x80 | (byte & 0x3f));
  }
  return utf8;
}

/// Parses a number with a decimal point or comma; nullopt for any other text and for an infinite number.
std::optional<double> diadem_number(std::string_view text) {
  std::string plain(text);
  if (std::count(plain.begin(), plain.end(), ',') == 1 && plain.find('.') == std::string::npos)
    std::replace(plain.begin(), plain.end(), ',', '.');
  const char *begin = plain.data() + (plain.starts_with('+') ? 1 : 0), *end = plain.data() + plain.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string quoted_line(int key, const std::string& value) {
  return fmt::format("line \"{},{}\"", key, shortened(value, kLongestName));
}

/// The lines of one channel by their numbers.
class DiademLines {
 public:
  void set(int key, std::string_view value) { lines_.emplace(key, as_utf8(value)); }
  std::string text(int key) const {
    const auto line = lines_.find(key);
    return line == lines_.end() ? "" : line->second;
  }

  DiademChannel channel() {
    DiademChannel made;
    made.name = text(kChannelName);
    made.unit = text(kChannelUnit);
    if (made.unit.starts_with('[') && made.unit.ends_with(']'))
      made.unit = made.unit.substr(1, made.unit.size() - 2);
    made.implicit = in_capitals(text(kChannelKind)).starts_with("IMPLI");
    made.values = count(kValueCount, 0);
    if (text(kValueCount).empty()) refuse(fmt::format("line {} (number of values) is missing", +kValueCount));
    made.start = number(kStartValue, 0.0);
    made.step = number(kStepWidth, 1.0);
    if (made.step == 0.0) refuse(quoted_line(kStepWidth, text(kStepWidth)) + " states a step or factor of 0");
    if (!made.implicit) read_storage(made);
    made.damage = damage_;
    return made;
  }

 private:
  void refuse(const std::string& why) {
    if (damage_.empty()) damage_ = why;
  }

  double number(int key, double otherwise) {
    const std::string value = text(key);
    if (value.empty()) return otherwise;
    const auto parsed = diadem_number(value);
    if (!parsed) refuse(quoted_line(key, value) + " has no number");
    return parsed.value_or(otherwise);
  }

  std::int64_t count(int key, std::int64_t least) {
    const double value = number(key, static_cast<double>(least));
    if (value >= static_cast<double>(least) && value <= kMostDiademValues && value == std::floor(value))
      return static_cast<std::int64_t>(value);
    refuse(fmt::format("{} is no whole number from {} to 10^12", quoted_line(key, text(key)), least));
    return least;
  }

  void read_storage(DiademChannel& made) {
    made.file = text(kDataFile);
    made.in_blocks = in_capitals(text(kStorage)) == "BLOCK";
    made.first = count(kFirstValue, 1);
    if (!text(kBlockWidth).empty() && text(kBlockWidth) != "0") made.block_width = count(kBlockWidth, 0);
    const std::string storage = in_capitals(text(kStorage)), type = in_capitals(text(kValueType));
    const auto known = std::find_if(std::begin(kDiademTypes), std::end(kDiademTypes),
                                    [&](const DiademTypeName& each) { return type == each.name; });
    if (known != std::end(kDiademTypes)) made.type = known->type;
    if (made.file.empty()) refuse(fmt::format("line {} (name of the data file) is missing", +kDataFile));
    if (storage != "BLOCK" && storage != "CHANNEL" && storage != "KANAL")
      refuse(quoted_line(kStorage, text(kStorage)) + " is neither CHANNEL nor BLOCK");
    if (known == std::end(kDiademTypes))
      refuse(
          fmt::format("its values are of type \"{}\", but REAL64, REAL32, INT16 and INT32 are read; save it "
                      "as REAL64 with DIAdem, or as CSV",
                      shortened(type, kLongestName)));
    if (!made.in_blocks && made.block_width)
      refuse(quoted_line(kBlockWidth, text(kBlockWidth)) + " has no known meaning for storage by channels");
  }

  std::map<int, std::string> lines_;  ///< the first line of a number counts
  std::string damage_;
};

class DiademHeaderParser {
 public:
  explicit DiademHeaderParser(const std::string& path) : path_(path) {}

  DiademHeader run(std::string_view text) {
    for (std::int64_t line = 1; !text.empty(); ++line) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      if (end > kLongestDiademLine)
        throw Error(ErrorCode::input, fmt::format("{}, line {}", path_, line),
                    fmt::format("has {} bytes, more than any line of a DIAdem header; the header is damaged. "
                                "Copy the trace from the controller again",
                                end));
      take(stripped_line(text.substr(0, end)));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (in_channel_) end_channel("its header is not complete");
    if (header_.channels.empty())
      throw Error(ErrorCode::input, path_,
                  "is a DIAdem header without channels (#BEGINCHANNELHEADER), so nothing was recorded, or it "
                  "was cut; copy the trace from the controller again");
    return std::move(header_);
  }

 private:
  void take(std::string_view line) {
    if (line.starts_with("#BEGINCHANNELHEADER")) {
      if (in_channel_) end_channel("its header has no end");
      in_channel_ = true;
    } else if (line.starts_with("#ENDCHANNELHEADER")) {
      if (in_channel_) end_channel("");
    } else if (const std::size_t comma = line.find(','); comma != std::string_view::npos) {
      int key = 0;
      const std::string_view digits = stripped_line(line.substr(0, comma)),
                             value = stripped_line(line.substr(comma + 1));
      const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), key);
      if (error != std::errc{} || stop != digits.data() + digits.size()) return;
      if (in_channel_)
        lines_.set(key, value);
      else
        take_global(key, value);
    }
  }

  void take_global(int key, std::string_view value) {
    if (key == kByteOrder) header_.big_endian = in_capitals(value).starts_with("LOW");
    if (key != kMissingMark) return;
    const double mark = diadem_number(value).value_or(0.0);
    if (std::abs(mark) >= kLeastMissingMark) header_.missing = mark;
  }

  void end_channel(const std::string& cut) {
    if (header_.channels.size() == kMostDiademChannels)
      throw Error(
          ErrorCode::input, path_,
          fmt::format("has more than {} channels; a log has less. Save the channels of the joints alone",
                      kMostDiademChannels));
    header_.channels.push_back(lines_.channel());
    if (!cut.empty()) header_.channels.back().damage = cut;
    lines_ = {};
    in_channel_ = false;
  }

  const std::string& path_;
  DiademHeader header_;
  DiademLines lines_;
  bool in_channel_ = false;
};

}  // namespace

std::size_t size_of(DiademType type) { return kDiademTypes[static_cast<std::size_t>(type)].bytes; }

DiademHeader read_diadem_header(std::string_view text, const std::string& path) {
  return DiademHeaderParser(path).run(text);
}

}  // namespace faultline
