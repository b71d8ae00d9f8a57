// SPDX-License-Identifier: MIT
#include "formats/csv/wide_rows.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace faultline {

bool read_number(const char* begin, const char* end, char decimal, double& value) {
  const fast_float::parse_options options(fast_float::chars_format::general, decimal);
  const auto [behind, error] = fast_float::from_chars_advanced(begin, end, value, options);
  return error == std::errc() && behind == end;
}

}  // namespace faultline

#if defined(__x86_64__)

#include "formats/csv/number_avx2.hpp"

namespace faultline {
namespace {

constexpr int kWideBlock = 64;  ///< bytes whose ends fit into one word of bits

/// Returns a bit for each of 64 bytes, set if it ends a field.
FAULTLINE_AVX2_INLINE std::uint64_t end_bits(const char* p, __m256i separator, __m256i newline) {
  const __m256i lower = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
  const __m256i upper = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p + avx2::kWidth));
  const __m256i lower_ends =
      _mm256_or_si256(_mm256_cmpeq_epi8(lower, separator), _mm256_cmpeq_epi8(lower, newline));
  const __m256i upper_ends =
      _mm256_or_si256(_mm256_cmpeq_epi8(upper, separator), _mm256_cmpeq_epi8(upper, newline));
  return static_cast<std::uint32_t>(_mm256_movemask_epi8(lower_ends)) |
         static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm256_movemask_epi8(upper_ends)))
             << avx2::kWidth;
}

bool has_number(const std::vector<double*>& columns, int row) {
  return std::any_of(columns.begin(), columns.end(),
                     [row](const double* values) { return values && !std::isnan(values[row]); });
}

}  // namespace

bool WideRows::can_read() const {
  static const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
                               __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("popcnt");
  return has_avx2 && separator_ != ' ';
}

/// Stores the positions of separators and newlines in ends_; returns their number.
FAULTLINE_AVX2 int WideRows::find_ends(const char* text, int size) {
  constexpr int kAtOnce = 4;  // written without testing how many remain
  const __m256i separator = _mm256_set1_epi8(separator_), newline = _mm256_set1_epi8('\n');
  std::uint32_t* out = ends_.data();
  for (int at = 0; at < size; at += kWideBlock) {
    std::uint64_t bits = end_bits(text + at, separator, newline);
    if (size - at < kWideBlock) bits = _bzhi_u64(bits, static_cast<unsigned>(size - at));
    const int count = static_cast<int>(_mm_popcnt_u64(bits));
    for (int i = 0; i < count; i += kAtOnce) {
      for (int k = 0; k < kAtOnce; ++k, bits = _blsr_u64(bits))
        out[i + k] = static_cast<std::uint32_t>(at) + static_cast<std::uint32_t>(_tzcnt_u64(bits));
    }
    out += count;
  }
  return static_cast<int>(out - ends_.data());
}

/// Reads the row at `p`, whose fields have the next `ends`; returns the position after it, or null.
FAULTLINE_AVX2_INLINE const char* WideRows::read_row(const char* text, const char* p,
                                                     const std::uint32_t* ends,
                                                     const std::vector<double*>& columns, int row) const {
  const int fields = static_cast<int>(columns.size());
  const char* end = text + ends[fields - 1];
  if (*end != '\n') return nullptr;
  bool some_empty = false;
  for (int field = 0; field < fields; ++field, p = end + 1) {
    end = text + ends[field];
    const char* last = end;
    if (field + 1 == fields)
      last -= end[-1] == '\r';
    else if (*end != separator_)
      return nullptr;
    while (*p == ' ') ++p;
    if (double* values = columns[field]) {
      if (p == last) {
        values[row] = std::numeric_limits<double>::quiet_NaN();
        some_empty = true;
      } else if (!avx2::read_number(p, last, decimal_, values[row])) {
        return nullptr;
      }
    } else if (std::memchr(p, '"', static_cast<std::size_t>(last - p))) {
      return nullptr;
    }
  }
  // A line without any number may be blank or a comment.
  return some_empty && !has_number(columns, row) ? nullptr : p;
}

FAULTLINE_AVX2 int WideRows::read(const char*& p, const char* end, const std::vector<double*>& columns,
                                  int row, int max_rows) {
  const int fields = static_cast<int>(columns.size()), first = row;
  while (fields > 0 && row < max_rows && p < end) {
    const char* const text = p;
    const int ends = find_ends(text, static_cast<int>(std::min<std::ptrdiff_t>(bytes_, end - text)));
    const int first_here = row;
    for (int used = 0; used + fields <= ends && row < max_rows; used += fields, ++row) {
      const char* behind = read_row(text, p, ends_.data() + used, columns, row);
      if (!behind) {
        bytes_ = kLeastBytes;
        return row - first;
      }
      p = behind;
    }
    if (row == first_here && bytes_ == kMostBytes) break;
    if (row < max_rows) bytes_ = std::min(2 * bytes_, kMostBytes);
  }
  return row - first;
}

}  // namespace faultline

#else

namespace faultline {

bool WideRows::can_read() const { return false; }

int WideRows::read(const char*&, const char*, const std::vector<double*>&, int, int) { return 0; }

}  // namespace faultline

#endif
