#include "agents/hud/style.hpp"

#include <gtest/gtest.h>

namespace lifeline::hud {
namespace {

TEST(HudStyle, ContrastIsWhatWcagSays) {
  EXPECT_NEAR(contrast(0x000000, 0xffffff), 21.0, 1e-9);
  EXPECT_NEAR(contrast(0x777777, 0xffffff), 4.48, 0.01);
  EXPECT_DOUBLE_EQ(contrast(0x123456, 0x123456), 1.0);
}

TEST(HudStyle, WhateverMustBeToldApartIs) {
  ASSERT_FALSE(colour_pairs().empty());
  for (const ColourPair& pair : colour_pairs())
    EXPECT_GE(contrast(pair.on, pair.ground), pair.is_text ? 4.5 : 3.0) << pair.what;
}

}  // namespace
}  // namespace lifeline::hud
