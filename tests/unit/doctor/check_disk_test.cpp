#include "common/doctor/check_disk.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/another_user.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::doctor {
namespace {

using testing::HasSubstr;
constexpr DiskNeed kNothing{0, 0};
constexpr auto kEndless = std::numeric_limits<std::uintmax_t>::max();

class CheckDisk : public testing::Test {
 protected:
  Finding check(const std::filesystem::path& folder, const DiskNeed& need = kNothing) {
    const auto found = check_folder("state", folder, "--state", need);
    EXPECT_EQ(found.size(), 1U);
    return found.front();
  }
  support::TemporaryFolder folder_;
};

TEST_F(CheckDisk, AFolderThatCanBeWrittenIsGoodAndLeftAsItWas) {
  EXPECT_EQ(check(folder_.path()).level, Level::ok);
  EXPECT_EQ(folder_.files(), 0U);
}

TEST_F(CheckDisk, AFolderThatIsStillToBeMadeIsNotMadeHere) {
  const Finding found = check(folder_.path() / "a/b");
  EXPECT_EQ(found.level, Level::ok);
  EXPECT_THAT(found.what, HasSubstr("will be made"));
  EXPECT_EQ(folder_.files(), 0U);
}

TEST_F(CheckDisk, AFileInItsPlaceIsAFault) {
  const Finding found = check(folder_.write("file", "x") / "state");
  EXPECT_EQ(found.level, Level::fault);
  EXPECT_THAT(found.what, HasSubstr("is no folder"));
  EXPECT_THAT(found.advice, HasSubstr("--state"));
}

TEST_F(CheckDisk, AFullDiskIsAFault) {
  const test::FullDisk full(1000);
  const Finding found = check(folder_.path());
  EXPECT_EQ(found.level, Level::fault);
  EXPECT_THAT(found.advice, HasSubstr("free space"));
}

TEST_F(CheckDisk, AFolderOfAnotherUserIsAFault) {
  std::filesystem::permissions(
      folder_.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  {
    const test::AnotherUser nobody;
    const Finding found = check(folder_.path());
    EXPECT_EQ(found.level, Level::fault);
    EXPECT_THAT(found.what, HasSubstr("denied"));
  }
  std::filesystem::permissions(folder_.path(), std::filesystem::perms::owner_all);
}

TEST_F(CheckDisk, LittleRoomIsWarnedOfAndTooLittleAFault) {
  EXPECT_EQ(check(folder_.path(), {0, kEndless}).level, Level::warning);
  EXPECT_EQ(check(folder_.path(), {kEndless, kEndless}).level, Level::fault);
}

class CheckSharedMemory : public CheckDisk {
 protected:
  CheckSharedMemory() {
    profile_.shared_memory = true;
    profile_.segment_octets = 1;
  }
  dds::ProfileFacts profile_;
};

TEST_F(CheckSharedMemory, IsLookedAtOnlyWhereItIsUsed) {
  profile_.shared_memory = false;
  EXPECT_TRUE(check_shared_memory(profile_, folder_.path()).empty());
}

TEST_F(CheckSharedMemory, MustBeThereAndBeWritable) {
  EXPECT_EQ(check_shared_memory(profile_, folder_.path()).at(0).level, Level::fault);
  std::filesystem::create_directories(folder_.path() / "dev/shm");
  EXPECT_EQ(check_shared_memory(profile_, folder_.path()).at(0).level, Level::ok);
  const test::FullDisk full(1000);
  EXPECT_EQ(check_shared_memory(profile_, folder_.path()).at(0).level, Level::fault);
}

}  // namespace
}  // namespace lifeline::doctor
