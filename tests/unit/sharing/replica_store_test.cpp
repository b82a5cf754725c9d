#include "common/sharing/replica_store.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "common/wire/limits.hpp"
#include "tests/support/sharing_samples.hpp"

namespace lifeline::sharing {
namespace {

using test::layer;
using test::tile_sample;

class ReplicaStoreTest : public testing::Test {
 protected:
  std::mt19937 random_{1};
  QuantisedTile old_cells_ = test::small_tile(random_), new_cells_ = test::small_tile(random_);
  ReplicaStore store_{GridGeometry{}};
};

TEST_F(ReplicaStoreTest, HoldsTheNewestRevisionWhateverTheOrderOfArrival) {
  const LayerKey alpha = layer("alpha");
  EXPECT_EQ(store_.apply(tile_sample(alpha, {0, 0}, 2, new_cells_)).value(), Applied::newer);
  EXPECT_EQ(store_.apply(tile_sample(alpha, {0, 0}, 1, old_cells_)).value(), Applied::older);
  EXPECT_EQ(store_.apply(tile_sample(alpha, {0, 0}, 2, new_cells_)).value(), Applied::repeated);
  EXPECT_EQ(*store_.find(alpha)->at({0, 0}).cells, new_cells_);
  EXPECT_EQ(store_.take_changed().size(), 1U) << "repeats and older revisions change nothing";
}

TEST_F(ReplicaStoreTest, DigestsAreEqualExactlyWhenRevisionsAre) {
  const LayerKey alpha = layer("alpha");
  ReplicaStore other{GridGeometry{}};
  ASSERT_TRUE(store_.apply(tile_sample(alpha, {0, 0}, 1, old_cells_)));
  ASSERT_TRUE(store_.apply(tile_sample(alpha, {3, -2}, 1, old_cells_)));
  ASSERT_TRUE(other.apply(tile_sample(alpha, {3, -2}, 1, old_cells_)));
  EXPECT_NE(store_.digest(alpha), other.digest(alpha));
  ASSERT_TRUE(other.apply(tile_sample(alpha, {0, 0}, 1, old_cells_)));
  EXPECT_EQ(store_.digest(alpha), other.digest(alpha));
  ASSERT_TRUE(other.apply(tile_sample(alpha, {0, 0}, 2, new_cells_)));
  EXPECT_NE(store_.digest(alpha), other.digest(alpha));
}

TEST_F(ReplicaStoreTest, RefusesATileOfSomebodyElsesLayer) {
  auto sample = tile_sample(layer("alpha"), {0, 0}, 1, old_cells_);
  sample.envelope.sender_id = "bravo";
  const auto applied = store_.apply(sample);
  ASSERT_FALSE(applied);
  EXPECT_NE(applied.error().text.find("bravo sent a tile of alpha's layer"), std::string::npos);
  EXPECT_TRUE(store_.layers().empty());
}

TEST_F(ReplicaStoreTest, RefusesTilesBeyondTheGrid) {
  EXPECT_FALSE(store_.apply(tile_sample(layer("alpha"), {kMaxTileIndex, 0}, 1, old_cells_)));
  EXPECT_FALSE(store_.apply(tile_sample(layer("alpha"), {0, -kMaxTileIndex - 1}, 1, old_cells_)));
  EXPECT_TRUE(store_.layers().empty());
}

TEST_F(ReplicaStoreTest, RefusesAPayloadThatDoesNotDecodeAndKeepsWhatItHeld) {
  const LayerKey alpha = layer("alpha");
  ASSERT_TRUE(store_.apply(tile_sample(alpha, {0, 0}, 1, old_cells_)));
  auto broken = tile_sample(alpha, {0, 0}, 2, new_cells_);
  broken.payload.resize(broken.payload.size() / 2);
  EXPECT_FALSE(store_.apply(broken));
  EXPECT_EQ(*store_.find(alpha)->at({0, 0}).cells, old_cells_);
  EXPECT_EQ(store_.find(alpha)->at({0, 0}).revision, Revision{1});
}

TEST_F(ReplicaStoreTest, ATileIsHeldOnceAllItsPartsAreThereInAnyOrder) {
  const LayerKey alpha = layer("alpha");
  const QuantisedTile cells = test::random_tile(random_);
  auto parts = test::tile_samples(alpha, {0, 0}, 3, cells);
  ASSERT_GT(parts.size(), 2U);
  std::shuffle(parts.begin(), parts.end(), random_);
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    EXPECT_EQ(store_.apply(parts[i]).value(), Applied::part);
    EXPECT_EQ(store_.apply(parts[i]).value(), Applied::part) << "a part that comes twice";
    EXPECT_EQ(store_.find(alpha), nullptr);
  }
  EXPECT_EQ(store_.apply(parts.back()).value(), Applied::newer);
  EXPECT_EQ(*store_.find(alpha)->at({0, 0}).cells, cells);
  EXPECT_EQ(store_.apply(parts.front()).value(), Applied::repeated);
}

TEST_F(ReplicaStoreTest, PartsOfTwoRevisionsAreNeverJoined) {
  const LayerKey alpha = layer("alpha");
  const QuantisedTile cells = test::random_tile(random_);
  const QuantisedTile before = test::random_tile(random_);
  const auto older = test::tile_samples(alpha, {0, 0}, 1, before);
  const auto newer = test::tile_samples(alpha, {0, 0}, 2, cells);
  ASSERT_EQ(store_.apply(older.front()).value(), Applied::part);
  for (std::size_t i = 1; i < newer.size(); ++i) ASSERT_TRUE(store_.apply(newer[i]));
  for (std::size_t i = 1; i < older.size(); ++i) ASSERT_TRUE(store_.apply(older[i]));
  EXPECT_EQ(*store_.find(alpha)->at({0, 0}).cells, before);
  EXPECT_EQ(store_.apply(newer.front()).value(), Applied::newer);
  EXPECT_EQ(*store_.find(alpha)->at({0, 0}).cells, cells);
}

TEST_F(ReplicaStoreTest, RefusesPartsThatCannotBe) {
  auto none = tile_sample(layer("alpha"), {0, 0}, 1, old_cells_);
  none.parts = 0;
  auto beyond = none, many = none, other = none;
  beyond.part = beyond.parts = 1;
  many.parts = wire::kMaxTileParts + 1;
  for (const auto& sample : {none, beyond, many}) EXPECT_FALSE(store_.apply(sample));
  other.parts = 2;
  ASSERT_EQ(store_.apply(other).value(), Applied::part);
  other.parts = 3;
  EXPECT_FALSE(store_.apply(other)) << "as many parts as the first one said";
  EXPECT_TRUE(store_.layers().empty());
}

TEST_F(ReplicaStoreTest, BeginsOnlySoManyTilesAtATime) {
  auto sample = tile_sample(layer("alpha"), {0, 0}, 1, old_cells_);
  sample.parts = 2;
  for (std::size_t i = 0; i < ReplicaStore::kMaxIncompleteTiles; ++i) {
    sample.tile_x = static_cast<std::int32_t>(i % 64);
    sample.tile_y = static_cast<std::int32_t>(i / 64);
    ASSERT_EQ(store_.apply(sample).value(), Applied::part);
  }
  sample.tile_x = -1;
  EXPECT_FALSE(store_.apply(sample));
  sample.tile_x = 0;  // begun above
  EXPECT_TRUE(store_.apply(sample)) << "one that was begun";
}

TEST_F(ReplicaStoreTest, RefusesOneLayerTooMany) {
  for (std::size_t i = 0; i < ReplicaStore::kMaxLayers; ++i) {
    auto sample = tile_sample(layer("h" + std::to_string(i)), {0, 0}, 1, old_cells_);
    ASSERT_TRUE(store_.apply(sample));
  }
  EXPECT_FALSE(store_.apply(tile_sample(layer("late"), {0, 0}, 1, old_cells_)));
}

TEST_F(ReplicaStoreTest, FingerprintDependsOnEpochMembersAndRevisions) {
  const LayerKey alpha = layer("alpha"), bravo = layer("bravo");
  ASSERT_TRUE(store_.apply(tile_sample(alpha, {0, 0}, 1, old_cells_)));
  const auto one = fingerprint(Epoch{1}, {alpha}, store_);
  EXPECT_NE(one, fingerprint(Epoch{2}, {alpha}, store_));
  EXPECT_NE(one, fingerprint(Epoch{1}, {alpha, bravo}, store_));
  ASSERT_TRUE(store_.apply(tile_sample(alpha, {0, 0}, 2, old_cells_)));
  EXPECT_NE(one, fingerprint(Epoch{1}, {alpha}, store_));
}

}  // namespace
}  // namespace lifeline::sharing
