// SPDX-License-Identifier: MIT
#include "formats/csv/number.hpp"

#include <fast_float/fast_float.h>

namespace faultline {

bool read_number(const char* begin, const char* end, char decimal, double& value) {
  const fast_float::parse_options options(fast_float::chars_format::general, decimal);
  const auto [behind, error] = fast_float::from_chars_advanced(begin, end, value, options);
  return error == std::errc() && behind == end;
}

}  // namespace faultline
