// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace faultline {

enum class DiademType { real64, real32, int16, int32 };

/// Size of a value in a data file, bytes.
std::size_t size_of(DiademType type);

/// A channel of a DIAdem header, with the numbers of the lines that state its properties. Texts are UTF-8.
struct DiademChannel {
  std::string name;                           ///< 200
  std::string unit;                           ///< 202, without square brackets
  bool implicit = false;                      ///< 210: value i is start + i * step, not stored
  std::string file;                           ///< 211: name of the data file
  bool in_blocks = false;                     ///< 213: the values of all channels alternate, row by row
  DiademType type = DiademType::real64;       ///< 214
  std::int64_t values = 0;                    ///< 220, 0 to 10^12
  std::int64_t first = 1;                     ///< 221: place of the first value in the data file, from 1
  std::optional<std::int64_t> block_width{};  ///< 222: values from one to the next of the channel
  double start = 0.0;                         ///< 240, for stored values an offset
  double step = 1.0;                          ///< 241, for stored values a factor
  std::string damage{};                       ///< the reason why it cannot be read, as a clause; else empty
};

/// The text file of a DIAdem recording.
struct DiademHeader {
  std::vector<DiademChannel> channels;
  bool big_endian = false;  ///< 112: "Low -> High"
  /// 111: stored in place of a missing value; NaN if there is none.
  double missing = std::numeric_limits<double>::quiet_NaN();
};

/// Parses the header at `path`. A channel that cannot be read has `damage`. Throws Error(input) for a line
/// that is too long, too many channels, or none.
DiademHeader read_diadem_header(std::string_view text, const std::string& path);

}  // namespace faultline
