// SPDX-License-Identifier: MIT
#include "lib/core/files/other_names.hpp"

#include <sys/stat.h>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

bool is_known_by_several(const struct stat& facts) { return S_ISREG(facts.st_mode) && facts.st_nlink > 1; }

}  // namespace

bool has_other_names(int descriptor) {
  struct stat facts {};
  return ::fstat(descriptor, &facts) == 0 && is_known_by_several(facts);
}

void refuse_other_names(const std::string& path) {
  struct stat facts {};
  if (::stat(path.c_str(), &facts) == 0 && is_known_by_several(facts))
    throw Error(ErrorCode::output, path,
                "has another name as well (a hard link), and writing here would change that file, too; "
                "nothing was changed. Replace it by a copy of the file");
}

}  // namespace faultline
