#include "common/bag/bag_writer.hpp"

#include <csignal>
#include <cstdlib>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/bag/bag_reader.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::bag {
namespace {

using Bytes = std::vector<std::uint8_t>;

const Topic kMap{"/lifeline/map", "nav_msgs/msg/OccupancyGrid"};
const Topic kTf{"/tf", "tf2_msgs/msg/TFMessage"};

Timestamp at(int ms) {
  return Timestamp(std::chrono::milliseconds(1'700'000'000'000 + ms));
}

class BagWriterTest : public ::testing::Test {
 protected:
  BagWriter create() {
    auto writer = BagWriter::create(bag());
    EXPECT_TRUE(writer) << writer.error().text;
    return *std::move(writer);
  }
  [[nodiscard]] std::filesystem::path bag() const { return folder_.path() / "records" / "bag"; }
  std::vector<Message> read() {
    std::vector<Message> messages;
    auto reader = BagReader::open(bag().string());
    EXPECT_TRUE(reader) << reader.error().text;
    while (reader) {
      auto message = reader->next();
      EXPECT_TRUE(message) << message.error().text;
      if (!message || !*message) break;
      messages.push_back(**std::move(message));
    }
    return messages;
  }

  support::TemporaryFolder folder_;
};

TEST_F(BagWriterTest, WhatWasWrittenIsReadInTheOrderOfItsStamps) {
  BagWriter writer = create();
  ASSERT_TRUE(writer.append(kTf, Durability::volatile_, at(20), Bytes{3}));
  ASSERT_TRUE(writer.append(kMap, Durability::transient_local, at(10), Bytes{1, 2}));
  ASSERT_TRUE(writer.close());
  const auto messages = read();
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0].topic.name, kMap.name);
  EXPECT_EQ(messages[0].topic.type, kMap.type);
  EXPECT_EQ(messages[0].stamp, at(10));
  EXPECT_EQ(messages[0].cdr, (Bytes{1, 2}));
  EXPECT_EQ(messages[1].cdr, Bytes{3});
  auto reader = BagReader::open((bag() / "bag_0.db3").string());
  ASSERT_TRUE(reader);
  const auto span = reader->span().value();
  ASSERT_TRUE(span);
  EXPECT_EQ(span->first, at(10));
  EXPECT_EQ(span->last, at(20));
}

TEST_F(BagWriterTest, AClosedBagIsOneFileThatCanBeReadFromAReadOnlyMedium) {
  BagWriter writer = create();
  ASSERT_TRUE(writer.append(kTf, Durability::volatile_, at(0), Bytes{3}));
  ASSERT_TRUE(writer.close());
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(bag())) ++files;
  EXPECT_EQ(files, 2U) << "the .db3 file and metadata.yaml";
  // The first 20 octets of the file say whether it needs a log beside it.
  EXPECT_EQ(support::content_of(bag() / "bag_0.db3")[18], 1);
}

TEST_F(BagWriterTest, TheMetadataCountWhatWasCommitted) {
  BagWriter writer = create();
  ASSERT_TRUE(writer.append(kTf, Durability::volatile_, at(10), Bytes{3}));
  ASSERT_TRUE(writer.append(kTf, Durability::volatile_, at(35), Bytes{3}));
  ASSERT_TRUE(writer.commit());
  ASSERT_TRUE(writer.append(kTf, Durability::volatile_, at(99), Bytes{3}));
  ASSERT_TRUE(writer.write_metadata());
  const std::string yaml = support::content_of(bag() / "metadata.yaml");
  for (const char* line :
       {"version: 5", "storage_identifier: sqlite3", "nanoseconds: 25000000", "message_count: 2",
        "nanoseconds_since_epoch: 1700000000010000000", "name: \"/tf\"", "- \"bag_0.db3\""}) {
    EXPECT_NE(yaml.find(line), std::string::npos) << line << "\n" << yaml;
  }
}

TEST_F(BagWriterTest, NothingIsEverWrittenOver) {
  BagWriter writer = create();
  ASSERT_TRUE(writer.close());
  const auto again = BagWriter::create(bag());
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::wrong_use);
  EXPECT_NE(again.error().text.find("never writes over"), std::string::npos);
}

TEST_F(BagWriterTest, WhatWasCommittedOutlivesAKilledProcess) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    auto writer = BagWriter::create(bag());
    bool written = writer.has_value();
    for (int i = 0; written && i < 500; ++i) {
      written = writer->append(kTf, Durability::volatile_, at(i), Bytes(1000, 7)).has_value();
      if (i == 399) written = written && writer->commit().has_value();
    }
    if (!written) ::_exit(1);
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(read().size(), 400U);
}

TEST_F(BagWriterTest, AFullDiskTakesBackWhatWasNotCommittedAndThereIsRoomAgainLater) {
  BagWriter writer = create();
  ASSERT_TRUE(writer.append(kTf, Durability::volatile_, at(0), Bytes{1}));
  ASSERT_TRUE(writer.commit());
  {
    const test::FullDisk full(200'000);
    bool failed = false;
    for (int i = 1; i < 100 && !failed; ++i) {
      failed = !writer.append(kMap, Durability::transient_local, at(i), Bytes(10'000, 1)) ||
               (i % 10 == 0 && !writer.commit());
    }
    ASSERT_TRUE(failed);
    EXPECT_EQ(writer.pending(), 0U);
  }
  const std::uint64_t before = writer.messages();
  EXPECT_LT(before, 21U);
  ASSERT_TRUE(writer.append(kMap, Durability::transient_local, at(200), Bytes{2}));
  ASSERT_TRUE(writer.append(kTf, Durability::volatile_, at(201), Bytes{4}));
  ASSERT_TRUE(writer.close());
  const auto messages = read();
  ASSERT_EQ(messages.size(), before + 2);
  EXPECT_EQ(messages.back().cdr, Bytes{4});
}

TEST_F(BagWriterTest, WhatIsCommittedIsReadBackWhileMoreIsWritten) {
  BagWriter writer = create();
  const auto is_tf = [](const Topic& topic) { return topic.name == kTf.name; };
  std::uint64_t after = 0;
  ASSERT_TRUE(writer.append(kTf, Durability::volatile_, at(10), Bytes{1}));
  ASSERT_TRUE(writer.append(kMap, Durability::transient_local, at(10), Bytes{9}));
  ASSERT_TRUE(writer.append(kTf, Durability::volatile_, at(20), Bytes{2, 3}));
  EXPECT_TRUE(writer.read(after, 10, is_tf).value().empty()) << "it may still be taken back";
  EXPECT_FALSE(writer.span());
  ASSERT_TRUE(writer.commit());
  ASSERT_TRUE(writer.append(kTf, Durability::volatile_, at(30), Bytes{4}));
  const auto first = writer.read(after, 2, is_tf).value();
  ASSERT_EQ(first.size(), 1U) << "it looks at no more than two";
  EXPECT_EQ(first[0].cdr, Bytes{1});
  EXPECT_EQ(first[0].stamp, at(10));
  const auto second = writer.read(after, 2, is_tf).value();
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].cdr, (Bytes{2, 3}));
  EXPECT_EQ(second[0].topic.type, kTf.type);
  EXPECT_EQ(writer.span()->last, at(20));
  ASSERT_TRUE(writer.commit());
  EXPECT_EQ(writer.read(after, 10, is_tf).value().at(0).cdr, Bytes{4});
  EXPECT_TRUE(writer.read(after, 10, is_tf).value().empty());
  ASSERT_TRUE(writer.close());
  EXPECT_EQ(writer.read(after, 10, is_tf).error().code, ErrorCode::unavailable);
  EXPECT_EQ(read().size(), 4U) << "reading left no log open";
}

TEST_F(BagWriterTest, WhatAFullDiskTookBackIsNeverRead) {
  BagWriter writer = create();
  const auto all = [](const Topic&) { return true; };
  std::uint64_t after = 0;
  {
    const test::FullDisk full(100'000);
    bool failed = false;
    for (int i = 1; i < 100 && !failed; ++i)
      failed = !writer.append(kMap, Durability::transient_local, at(i), Bytes(10'000, 1));
    failed = failed || !writer.commit();
    ASSERT_TRUE(failed);
    EXPECT_TRUE(writer.read(after, 1000, all).value().empty());
  }
  ASSERT_TRUE(writer.append(kTf, Durability::volatile_, at(200), Bytes{2}));
  ASSERT_TRUE(writer.commit());
  const auto left = writer.read(after, 1000, all).value();
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].topic.name, kTf.name);
}

}  // namespace
}  // namespace lifeline::bag
