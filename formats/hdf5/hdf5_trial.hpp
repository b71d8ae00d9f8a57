// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace faultline {

/// Whether `work` comes to an end, be it by an Error, in a copy of this process. The HDF5 library crashes on
/// some damaged files; what it did not survive there is not tried here.
bool survives(const std::function<void()>& work);

}  // namespace faultline
