// SPDX-License-Identifier: MIT
#include "apps/work/model_paths.hpp"

#include "lib/cases/case_file.hpp"

namespace faultline {

std::string ModelPaths::case_base() const { return cases.empty() ? case_base_path(model) : cases; }

}  // namespace faultline
