// SPDX-License-Identifier: MIT
#include "lib/log/channels.hpp"

namespace faultline {

const char* to_string(MessageTime time) { return time == MessageTime::header ? "header" : "receipt"; }

}  // namespace faultline
