// What others notice when a process dies without a word.

#include <csignal>

#include "tests/integration/dds/processes.hpp"

namespace lifeline::test {
namespace {

using Crash = DdsProcesses;

TEST_F(Crash, of_a_writer_leaves_its_readers_working) {
  const auto reader = probe({"collect", "--tiles", "30", "--epoch", "1", "--seconds", "60"});
  const auto first = publisher({"--tiles", "10", "--id", "first"});
  ASSERT_TRUE(reader->wait_for_output("\"sender\":\"first\"", kPatience)) << reader->output();
  first->send(SIGKILL);
  ASSERT_EQ(first->wait(kPatience).status, 128 + SIGKILL);

  const auto second = publisher({"--tiles", "30", "--id", "second", "--epoch", "1"});

  const auto ended = reader->wait(kPatience);
  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_EQ(json_lines(ended.output, "sender", "second").size(), 31U) << ended.output;
}

TEST_F(Crash, of_a_reader_leaves_its_writer_working) {
  const auto writer = publisher({"--tiles", "100", "--epoch", "1", "--repeat"});
  const auto first = probe({"collect", "--tiles", "101", "--seconds", "60"});
  ASSERT_TRUE(first->wait_for_output("\"topic\":\"tsd_tile\"", kPatience)) << first->output();
  first->send(SIGKILL);

  const auto second = probe({"collect", "--tiles", "100", "--epoch", "1"})->wait(kPatience);
  EXPECT_EQ(second.status, 0) << second.output;

  // Leaving with an unacknowledged history must not hang.
  writer->send(SIGTERM);
  EXPECT_EQ(writer->wait(kPatience).status, 0) << writer->output();
}

TEST_F(Crash, of_the_primary_coordinator_lets_the_standby_be_heard) {
  const auto primary = publisher({"--id", "primary", "--epoch", "5", "--repeat"});
  const auto reader = probe({"collect", "--tiles", "1", "--seconds", "60"});
  ASSERT_TRUE(reader->wait_for_output("\"sender\":\"primary\"", kPatience)) << reader->output();
  const auto standby = publisher({"--id", "standby", "--epoch", "6", "--repeat", "--standby"});
  std::this_thread::sleep_for(std::chrono::seconds(2));
  const auto while_alive = reader->output();
  primary->send(SIGKILL);

  EXPECT_TRUE(reader->wait_for_output("\"sender\":\"standby\"", kPatience)) << reader->output();
  EXPECT_TRUE(json_lines(while_alive, "sender", "standby").empty()) << while_alive;
}

TEST_F(Crash, is_not_needed_for_the_standby_when_the_primary_leaves) {
  const auto primary = publisher({"--id", "primary", "--epoch", "5", "--repeat"});
  const auto reader = probe({"collect", "--tiles", "1", "--seconds", "60"});
  ASSERT_TRUE(reader->wait_for_output("\"sender\":\"primary\"", kPatience)) << reader->output();
  const auto standby = publisher({"--id", "standby", "--epoch", "6", "--repeat", "--standby"});
  primary->send(SIGTERM);
  EXPECT_EQ(primary->wait(kPatience).status, 0);

  EXPECT_TRUE(reader->wait_for_output("\"sender\":\"standby\"", kPatience)) << reader->output();
}

}  // namespace
}  // namespace lifeline::test
