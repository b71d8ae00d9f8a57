// SPDX-License-Identifier: MIT
#pragma once

#include <httplib.h>

// <resolv.h>, which it includes, gives this name a meaning that Eigen's headers do not survive.
#undef _res
