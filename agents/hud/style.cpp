#include "agents/hud/style.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lifeline::hud {
namespace {

double linear(unsigned part) {
  const double value = part / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double luminance(Colour colour) {
  return 0.2126 * linear((colour >> 16U) & 0xffU) + 0.7152 * linear((colour >> 8U) & 0xffU) +
         0.0722 * linear(colour & 0xffU);
}

constexpr std::array<ColourPair, 19> kPairs{{
    {"lit floor beside the unknown", kFloor, kGround, false},
    {"wall beside the floor", kWall, kFloor, false},
    {"wall beside the unknown", kWall, kGround, false},
    {"remembered wall beside its floor", kDimWall, kDimFloor, false},
    {"text on a panel", kInk, kGround, true},
    {"faint text on a panel", kFaint, kGround, true},
    {"way out's text on a panel", kWay, kGround, true},
    {"way out on the floor", kWay, kFloor, false},
    {"own arrow on the floor", kInk, kFloor, false},
    {"mate on the floor", kMate, kFloor, false},
    {"old mate on the floor", kFaint, kFloor, false},
    {"find on the floor", kFind, kFloor, false},
    {"rim of a sign on the floor", kGround, kFloor, false},
    {"mayday's ring in its rim", kMayday, kGround, false},
    {"letters on a mate", kGround, kMate, true},
    {"letters on an old mate", kFaint, kGround, true},
    {"letters on a mayday", kGround, kMayday, true},
    {"letters on an order", kGround, kOrder, true},
    {"letters on a roll call", kGround, kInk, true},
}};

}  // namespace

double contrast(Colour a, Colour b) {
  const double one = luminance(a), other = luminance(b);
  return (std::max(one, other) + 0.05) / (std::min(one, other) + 0.05);
}

std::span<const ColourPair> colour_pairs() {
  return kPairs;
}

}  // namespace lifeline::hud
