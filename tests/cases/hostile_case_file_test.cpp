// SPDX-License-Identifier: MIT
// Case bases that were changed by something else than this program: damaged, of an earlier version, or made
// to do harm, also under a digest that fits.
#include <gtest/gtest.h>

#include <filesystem>

#include "lib/cases/case_file.hpp"
#include "lib/cases/case_schema.hpp"
#include "lib/cases/sqlite.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "tests/cases/example_base.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

class HostileCaseFile : public testing::Test {
 protected:
  HostileCaseFile() { write_case_base(path_, example_base(5)); }

  /// As another program would, which distrusts nothing.
  void run(const std::string& sql) { SqliteFile(path_, SqliteMode::change).run(sql.c_str()); }

  std::string refusal() const {
    try {
      read_case_base(path_);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input);
      return error.message();
    }
    return "it was read";
  }

  /// Makes the digest fit what was changed.
  void reseal() {
    SqliteFile file(path_, SqliteMode::change);
    file.run(("UPDATE identity SET digest = '" + case_tables_digest(file) + "'").c_str());
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.file("robot.cases.db");
};

TEST_F(HostileCaseFile, AFlippedBitIsRefusedOrChangesNoContent) {
  CaseBase base = example_base(5);
  base.belong_to("0123456789abcdef");
  write_case_base(path_, base);
  const std::string whole = read_file(path_), content = to_cases_json(base);
  Random random(5);
  int refused = 0;
  for (int i = 0; i < 600; ++i) {
    std::string bytes = whole;
    const std::size_t at = random.below(bytes.size());
    bytes[at] ^= static_cast<char>(1 << random.below(8));
    write_file(path_, bytes);
    try {
      EXPECT_EQ(to_cases_json(read_case_base(path_)), content) << "byte " << at;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 50) << "most bytes of so small a base are unused";
}

TEST_F(HostileCaseFile, AChangedNumberIsRefused) {
  run("UPDATE feature SET weight = weight * 0.999 WHERE position = 1");
  EXPECT_NE(refusal().find("does not match its digest"), std::string::npos) << refusal();
}

TEST_F(HostileCaseFile, AChangedModelIdentityIsRefused) {
  run("UPDATE identity SET model = 'another'");
  EXPECT_NE(refusal().find("does not match its digest"), std::string::npos) << refusal();
}

TEST_F(HostileCaseFile, AnEndlessViewIsRefusedAtOnce) {
  run("ALTER TABLE fault_case RENAME TO gone; CREATE VIEW fault_case AS WITH RECURSIVE n(id) AS (SELECT 1 "
      "UNION ALL SELECT id + 1 FROM n) SELECT id FROM n");
  EXPECT_NE(refusal().find("the view \"fault_case\""), std::string::npos) << refusal();
  EXPECT_THROW(change_case_base(path_, [](CaseBase&) {}), Error);
  EXPECT_THROW(write_case_base(path_, example_base(1)), Error);
}

TEST_F(HostileCaseFile, ATriggerIsRefusedAndDoesNotRun) {
  run("CREATE TRIGGER t AFTER INSERT ON fault_case BEGIN UPDATE fault_case SET kind = 'locked'; END");
  EXPECT_NE(refusal().find("the trigger \"t\""), std::string::npos) << refusal();
  EXPECT_THROW(change_case_base(path_, [](CaseBase& base) { base.confirm(1); }), Error);
  SqliteFile file(path_, SqliteMode::read_only);
  EXPECT_LT(file.number("SELECT count(*) FROM fault_case WHERE kind = 'locked'"), 15);
}

TEST_F(HostileCaseFile, AnEndlessStatementIsStopped) {
  SqliteFile file(path_, SqliteMode::read_only);
  EXPECT_THROW(
      file.number("WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT max(i) FROM n"),
      Error);
}

TEST_F(HostileCaseFile, ADeviceIsNotACaseBase) {
  EXPECT_THROW(read_case_base("/dev/zero"), Error);
  EXPECT_THROW(write_case_base("/dev/null", example_base(1)), Error);
}

TEST_F(HostileCaseFile, ACaseBaseOfAnEarlierVersionIsRefusedWithAdviceAndKept) {
  for (const char* version : {"1", "2"}) {
    run(std::string("PRAGMA user_version = ") + version);
    const std::string before = read_file(path_);
    EXPECT_NE(refusal().find(std::string("schema ") + version + " of an earlier program"), std::string::npos)
        << refusal();
    EXPECT_NE(refusal().find("learn the model again"), std::string::npos) << refusal();
    EXPECT_THROW(change_case_base(path_, [](CaseBase&) {}), Error);
    EXPECT_THROW(write_case_base(path_, example_base(1)), Error);
    EXPECT_EQ(read_file(path_), before);
  }
}

TEST_F(HostileCaseFile, AChangedPersonIsRefused) {
  run("UPDATE fault_case SET person = 'somebody else' WHERE id = 1");
  EXPECT_NE(refusal().find("does not match its digest"), std::string::npos) << refusal();
}

TEST_F(HostileCaseFile, LostRowsAreRefusedDespiteAFittingDigest) {
  run("DELETE FROM fault_case WHERE id = 5");
  reseal();
  EXPECT_NE(refusal().find("incomplete"), std::string::npos) << refusal();
}

TEST_F(HostileCaseFile, UnknownWordsAreRefusedDespiteAFittingDigest) {
  run("UPDATE fault_case SET kind = 'rust' WHERE id = 5");
  reseal();
  EXPECT_NE(refusal().find("rust"), std::string::npos) << refusal();
}

TEST_F(HostileCaseFile, ImpossibleNumbersAreRefusedDespiteAFittingDigest) {
  for (const char* change :
       {"UPDATE fault_case SET evidence = 1e308 WHERE id = 5", "UPDATE feature SET scale = 1e308",
        "UPDATE fault_case SET joint = 99 WHERE id = 5", "UPDATE fault_case SET mlp_confidence = -1",
        "UPDATE metric SET near_similarity = 7"}) {
    std::filesystem::remove(path_);
    write_case_base(path_, example_base(5));
    run(change);
    reseal();
    EXPECT_NE(refusal(), "it was read") << change;
    EXPECT_EQ(refusal().find("does not match its digest"), std::string::npos) << change;
  }
}

}  // namespace
}  // namespace faultline
