// SPDX-License-Identifier: MIT
// What libFuzzer calls; FAULTLINE_FEED is the reader of this program.
#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/readers/readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  faultline::FAULTLINE_FEED(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
