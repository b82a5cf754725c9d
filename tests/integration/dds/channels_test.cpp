// Participants of one process.

#include <algorithm>
#include <atomic>
#include <thread>

#include "common/dds/channel.hpp"
#include "tests/integration/dds/probe_samples.hpp"
#include "tests/integration/dds/processes.hpp"
#include "tests/unit/dds/message_fields.hpp"

namespace lifeline::test {
namespace {

using dds::make_inbox;
using dds::make_outbox;
using dds::Participant;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

std::unique_ptr<Participant> join(const TestDomain& domain, const std::string& name) {
  auto participant =
      Participant::create({domain.id(), LIFELINE_SOURCE_DIR "/config/qos/loopback.xml", name});
  if (!participant) throw std::runtime_error(participant.error().text);
  return *std::move(participant);
}

template <typename Condition>
bool eventually(Condition condition) {
  const auto end = steady_clock::now() + kPatience;
  while (steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(milliseconds(5));
  }
  return false;
}

template <typename Message>
class Channels : public ::testing::Test {
 protected:
  TestDomain domain_;
  std::unique_ptr<Participant> alpha_ = join(domain_, "alpha");
  std::unique_ptr<Participant> bravo_ = join(domain_, "bravo");
};

using Messages =
    ::testing::Types<wire::HelmetPose, wire::HelmetScan, wire::TsdTile, wire::TileRequest,
                     wire::TileCopy, wire::MergeDirective, wire::DirectiveCopy, wire::MergeEvidence,
                     wire::AgentStatus, wire::Detection, wire::Alert>;
TYPED_TEST_SUITE(Channels, Messages);

TYPED_TEST(Channels, carry_a_message_to_others_and_not_to_oneself) {
  const auto out = make_outbox<TypeParam>(*this->alpha_);
  const auto own = make_inbox<TypeParam>(*this->alpha_);
  const auto in = make_inbox<TypeParam>(*this->bravo_);
  ASSERT_TRUE(out) << out.error().text;
  ASSERT_TRUE(own) << own.error().text;
  ASSERT_TRUE(in) << in.error().text;
  const auto message = test::filled<TypeParam>();
  // Topics that keep nothing for late joiners reach only readers that are matched already.
  std::vector<TypeParam> got;
  ASSERT_TRUE(eventually([&] {
    EXPECT_TRUE((*out)->put(message));
    got = (*in)->take();
    return !got.empty();
  }));

  EXPECT_TRUE(test::same(got.front(), message));
  EXPECT_TRUE((*own)->take().empty());
  EXPECT_EQ((*in)->refused(), 0U);
  EXPECT_TRUE((*out)->has_reader());
  EXPECT_GT(this->alpha_->bytes_sent(), 40U);
  EXPECT_EQ(this->bravo_->bytes_sent(), 0U);
}

class Channel : public ::testing::Test {
 protected:
  TestDomain domain_;
};

TEST_F(Channel, tells_whether_anybody_reads) {
  const auto alpha = join(domain_, "alpha"), bravo = join(domain_, "bravo");
  const auto out = make_outbox<wire::HelmetScan>(*alpha).value();
  EXPECT_FALSE(out->has_reader());
  auto in = make_inbox<wire::HelmetScan>(*bravo).value();
  EXPECT_TRUE(eventually([&] { return out->has_reader(); }));
  in.reset();
  EXPECT_TRUE(eventually([&] { return !out->has_reader(); }));
}

TEST_F(Channel, refuses_a_message_beyond_its_bounds_and_goes_on) {
  const auto alpha = join(domain_, "alpha");
  const auto out = make_outbox<wire::TsdTile>(*alpha).value();
  const auto put = out->put(probe::tile("alpha", 0, 1, 1001));
  ASSERT_FALSE(put);
  EXPECT_EQ(put.error().code, ErrorCode::bad_data);
  EXPECT_EQ(alpha->bytes_sent(), 0U);
  EXPECT_TRUE(out->put(probe::tile("alpha", 0, 1, 1000)));
  EXPECT_GT(alpha->bytes_sent(), 1000U);
}

TEST_F(Channel, hands_out_in_order_of_arrival) {
  const auto alpha = join(domain_, "alpha"), bravo = join(domain_, "bravo");
  const auto out = make_outbox<wire::TsdTile>(*alpha).value();
  const auto in = make_inbox<wire::TsdTile>(*bravo).value();
  ASSERT_TRUE(eventually([&] { return out->has_reader(); }));
  // Keys in an order of their own, each written once.
  std::vector<std::int32_t> sent;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const auto tile = probe::tile("alpha", i * 37 % 50, 1, 100);
    sent.push_back(tile.tile_x);
    ASSERT_TRUE(out->put(tile));
  }
  std::vector<std::int32_t> got;
  EXPECT_TRUE(eventually([&] {
    for (const auto& tile : in->take()) got.push_back(tile.tile_x);
    return got.size() >= sent.size();
  }));
  EXPECT_EQ(got, sent);
}

TEST_F(Channel, wakes_a_loop_that_waits_for_any_inbox) {
  const auto alpha = join(domain_, "alpha"), bravo = join(domain_, "bravo");
  const auto poses = make_inbox<wire::HelmetPose>(*bravo).value();
  const auto alerts = make_inbox<wire::Alert>(*bravo).value();
  EXPECT_FALSE(bravo->wait_for_data(milliseconds(20)));
  const auto out = make_outbox<wire::Alert>(*alpha).value();
  ASSERT_TRUE(out->put(wire::Alert{}));
  EXPECT_TRUE(bravo->wait_for_data(kPatience));
  EXPECT_EQ(alerts->take().size(), 1U);
  EXPECT_TRUE(poses->take().empty());
  EXPECT_FALSE(bravo->wait_for_data(milliseconds(20)));

  std::thread waker([&] { bravo->wake(); });
  EXPECT_TRUE(bravo->wait_for_data(kPatience));
  waker.join();
}

TEST_F(Channel, outlives_its_participant) {
  auto alpha = join(domain_, "alpha"), bravo = join(domain_, "bravo");
  const auto out = make_outbox<wire::TsdTile>(*alpha).value();
  const auto in = make_inbox<wire::TsdTile>(*bravo).value();
  alpha.reset();
  bravo.reset();
  EXPECT_TRUE(out->put(probe::tile("alpha", 1, 1, 10)));
  EXPECT_TRUE(eventually([&] { return !in->take().empty(); }));
}

TEST_F(Channel, closes_while_samples_are_on_their_way) {
  const auto alpha = join(domain_, "alpha"), bravo = join(domain_, "bravo");
  const auto in = make_inbox<wire::TsdTile>(*bravo).value();
  for (int round = 0; round < 20; ++round) {
    const auto out = make_outbox<wire::TsdTile>(*alpha).value();
    const auto passing = make_inbox<wire::TsdTile>(*bravo).value();
    const bool matched = round % 2 == 1 || eventually([&] { return out->has_reader(); });
    ASSERT_TRUE(matched);
    for (std::uint32_t i = 0; i < 40; ++i) ASSERT_TRUE(out->put(probe::tile("alpha", i, 1, 1000)));
  }
  EXPECT_TRUE(eventually([&] { return !in->take().empty(); }));
}

// Both directions at once, each in a thread of its own as in an agent, with own readers beside.
TEST_F(Channel, carries_two_ways_at_once) {
  constexpr std::uint64_t kRevisions = 300;
  const auto run = [&](const std::string& name, const std::string& other) {
    const auto participant = join(domain_, name);
    const auto out = make_outbox<wire::TsdTile>(*participant).value();
    const auto in = make_inbox<wire::TsdTile>(*participant).value();
    std::uint64_t sent = 0, newest = 0;
    const auto end = steady_clock::now() + kPatience;
    while (steady_clock::now() < end && (sent < kRevisions || newest < kRevisions)) {
      if (sent < kRevisions && !out->put(probe::tile(name, 0, ++sent, 1000))) return false;
      participant->wait_for_data(milliseconds(1));
      for (const auto& tile : in->take()) {
        if (tile.envelope.sender_id != other || tile.payload != probe::payload(tile)) return false;
        if (tile.revision <= newest) return false;
        newest = tile.revision;
      }
    }
    // Stays until the other has what it waits for.
    std::this_thread::sleep_for(milliseconds(500));
    return newest == kRevisions;
  };
  bool bravo_done = false;
  std::thread thread([&] { bravo_done = run("bravo", "alpha"); });
  EXPECT_TRUE(run("alpha", "bravo"));
  thread.join();
  EXPECT_TRUE(bravo_done);
}

}  // namespace
}  // namespace lifeline::test
