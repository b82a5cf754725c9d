#include "common/files/atomic_file.hpp"

#include <gmock/gmock.h>

#include "common/files/read_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::files {
namespace {

using ::testing::HasSubstr;

TEST(AtomicFile, ReplacesTheContentAndLeavesNothingElseBehind) {
  const support::TemporaryFolder folder;
  const auto file = folder.path() / "a.txt";
  ASSERT_TRUE(write_file_atomically(file, "first and longer"));
  ASSERT_TRUE(write_file_atomically(file, std::string("x\0y", 3)));
  EXPECT_EQ(read_file(file, 100).value(), std::string("x\0y", 3));
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, EverybodyMayReadIt) {
  const support::TemporaryFolder folder;
  ASSERT_TRUE(write_file_atomically(folder.path() / "a.txt", "x"));
  const auto allowed = std::filesystem::status(folder.path() / "a.txt").permissions();
  EXPECT_NE(allowed & std::filesystem::perms::others_read, std::filesystem::perms::none);
}

TEST(AtomicFile, AFolderThatIsNotThereIsNamed) {
  const support::TemporaryFolder folder;
  const auto written = write_file_atomically(folder.path() / "no" / "a.txt", "x");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::unavailable);
  EXPECT_THAT(written.error().text, HasSubstr("no/a.txt: cannot be written (No such file"));
}

TEST(AtomicFile, AFailedWriteLeavesNothingBehind) {
  const support::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "taken");
  EXPECT_FALSE(write_file_atomically(folder.path() / "taken", "x"));
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, IsThereOnceItIsCommitted) {
  const support::TemporaryFolder folder;
  const auto name = folder.path() / "a.txt";
  auto file = AtomicFile::create(name);
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->append("one "));
  ASSERT_TRUE(file->append("two"));
  EXPECT_FALSE(std::filesystem::exists(name));
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(read_file(name, 100).value(), "one two");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, WhatIsNeverCommittedLeavesTheOldContent) {
  const support::TemporaryFolder folder;
  const auto name = folder.write("a.txt", "old");
  {
    auto file = AtomicFile::create(name);
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->append("new"));
    const AtomicFile moved = *std::move(file);
  }
  EXPECT_EQ(read_file(name, 100).value(), "old");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(ReadFile, AFileLargerThanAllowedIsRefused) {
  const support::TemporaryFolder folder;
  const auto file = folder.write("a.txt", "0123456789");
  EXPECT_EQ(read_file(file, 10).value(), "0123456789");
  ASSERT_FALSE(read_file(file, 9));
  EXPECT_EQ(read_file(file, 9).error().code, ErrorCode::bad_data);
}

}  // namespace
}  // namespace lifeline::files
