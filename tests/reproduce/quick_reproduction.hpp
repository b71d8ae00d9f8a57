// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "lib/reproduce/page/result_table.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline::testing {

/// One run of `faultline reproduce --quick`, which all tests of its results share, since it takes most of a
/// minute. Styles of figures are not in its index.json.
class QuickReproduction : public ::testing::Test {
 protected:
  static void SetUpTestSuite();
  static void TearDownTestSuite();

  /// The folder that the program wrote.
  static std::filesystem::path out() { return folder_->path() / "paper"; }
  static std::string summary;   ///< what the program printed
  static nlohmann::json index;  ///< index.json
  static StudyResult generator, classifier, runs;

 private:
  static std::unique_ptr<TemporaryFolder> folder_;
};

}  // namespace faultline::testing
