// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// A model and its case base.
struct ModelPaths {
  std::string model;
  std::string cases;  ///< empty: beside the model

  std::string case_base() const;
};

}  // namespace faultline
