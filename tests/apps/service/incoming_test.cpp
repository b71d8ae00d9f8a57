// SPDX-License-Identifier: MIT
#include "apps/service/incoming.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

TEST(Incoming, IsRemovedWithItsFilesIfNoQueueTookIt) {
  const TemporaryFolder folder;
  const ServiceFolder service(folder.path().string());
  std::string lost;
  {
    const Incoming incoming(service);
    lost = incoming.log("a.csv");
    folder.write(fs::relative(lost, folder.path()).string(), "t,q1\n");
    EXPECT_TRUE(fs::exists(lost));
  }
  EXPECT_FALSE(fs::exists(lost));
  EXPECT_TRUE(fs::is_empty(fs::path(lost).parent_path().parent_path().parent_path()));
}

}  // namespace
}  // namespace faultline
