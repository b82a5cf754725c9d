// The HUD's pictures beside those in tests/golden/hud/*.png, which people have looked at. After a
// change that is meant: LIFELINE_RENEW_HUD=1 build/dev/tests/golden/hud/hud_golden_test, then look
// at every one that git calls changed.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include <cairo.h>
#include <gtest/gtest.h>

#include "agents/hud/draw_hud.hpp"
#include "tests/golden/hud/situations.hpp"

namespace lifeline::test {
namespace {

constexpr int kWidth = 400, kHeight = 240;
using Pixels = std::vector<std::uint32_t>;

std::filesystem::path file_of(const std::string& name) {
  return std::filesystem::path(LIFELINE_SOURCE_DIR) / "tests/golden/hud" / (name + ".png");
}

Pixels draw(const hud::HudPicture& picture, const hud::HudMap& map) {
  hud::Pen pen(kWidth, kHeight);
  hud::draw_hud(picture, map, pen);
  const auto pixels = pen.pixels();
  return {pixels.begin(), pixels.end()};
}

Pixels read(const std::filesystem::path& file) {
  cairo_surface_t* image = cairo_image_surface_create_from_png(file.c_str());
  Pixels pixels;
  if (cairo_surface_status(image) == CAIRO_STATUS_SUCCESS &&
      cairo_image_surface_get_width(image) == kWidth &&
      cairo_image_surface_get_height(image) == kHeight) {
    const auto* row = cairo_image_surface_get_data(image);
    for (int y = 0; y < kHeight; ++y, row += cairo_image_surface_get_stride(image)) {
      const auto* first = reinterpret_cast<const std::uint32_t*>(row);
      pixels.insert(pixels.end(), first, first + kWidth);
    }
  }
  cairo_surface_destroy(image);
  return pixels;
}

int difference(std::uint32_t a, std::uint32_t b) {
  int most = 0;
  for (const unsigned shift : {0U, 8U, 16U}) {
    const auto part = [shift](std::uint32_t p) { return static_cast<int>((p >> shift) & 0xffU); };
    most = std::max(most, std::abs(part(a) - part(b)));
  }
  return most;
}

/// Pixels that differ by more than an edge's smoothing may. Whatever is drawn is larger than
/// kMostDifferent.
constexpr int kEdge = 64;
constexpr std::size_t kMostDifferent = 12;
std::size_t different(const Pixels& a, const Pixels& b) {
  if (a.size() != b.size()) return std::max(a.size(), b.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += difference(a[i], b[i]) > kEdge ? 1U : 0U;
  return count;
}

TEST(HudGolden, EverySituationLooksAsItDidWhenPeopleLookedAtIt) {
  const bool renew = std::getenv("LIFELINE_RENEW_HUD") != nullptr;
  for (const Situation& situation : hud_situations()) {
    if (renew) {
      hud::Pen pen(kWidth, kHeight);
      hud::draw_hud(situation.picture, situation.core->map(), pen);
      std::ofstream(file_of(situation.name), std::ios::binary) << pen.png().value();
    }
    const Pixels expected = read(file_of(situation.name));
    ASSERT_FALSE(expected.empty()) << file_of(situation.name) << " cannot be read";
    EXPECT_LE(different(draw(situation.picture, situation.core->map()), expected), kMostDifferent)
        << situation.name << ": see the top of this file";
  }
}

/// Takes one thing out of a picture, if it is there.
using Spoil = bool (*)(hud::HudPicture&);
const std::map<std::string, Spoil> kSpoils{
    {"a mate", [](hud::HudPicture& p) { return !p.mates.empty() && (p.mates.pop_back(), true); }},
    {"a find", [](hud::HudPicture& p) { return !p.finds.empty() && (p.finds.pop_back(), true); }},
    {"a band", [](hud::HudPicture& p) { return !p.bands.empty() && (p.bands.pop_back(), true); }},
    {"the way out", [](hud::HudPicture& p) { return p.way_out && (p.way_out.reset(), true); }},
    {"where to search", [](hud::HudPicture& p) { return p.search && (p.search.reset(), true); }},
    {"a bar of trust",
     [](hud::HudPicture& p) { return p.trust_bars > 0 && (--p.trust_bars, true); }},
    {"a bar of the link",
     [](hud::HudPicture& p) { return p.link_bars > 0 && (--p.link_bars, true); }},
    {"whose map it is", [](hud::HudPicture& p) { return p.shared = !p.shared, true; }},
    {"a second of the map's age",
     [](hud::HudPicture& p) { return p.map_age_s = *p.map_age_s + 1.0, true; }},
    {"the heading",
     [](hud::HudPicture& p) { return p.heading_known && (p.heading_known = false, true); }},
    {"a tenth of the bar",
     [](hud::HudPicture& p) { return p.hold_share > 0.0 && (p.hold_share -= 0.1, true); }},
    {"that a mate calls for help",
     [](hud::HudPicture& p) {
       for (auto& mate : p.mates) {
         if (std::exchange(mate.calls_for_help, false)) return true;
       }
       return false;
     }},
    {"that a mate is old",
     [](hud::HudPicture& p) {
       for (auto& mate : p.mates) {
         if (std::exchange(mate.stale, false)) return true;
       }
       return false;
     }},
    {"where a mayday is",
     [](hud::HudPicture& p) {
       for (auto& band : p.bands) {
         if (std::exchange(band.bearing_rad, std::nullopt)) return true;
       }
       return false;
     }},
    {"that it is the own trail",
     [](hud::HudPicture& p) {
       return p.way_out && p.way_out->by_own_trail && (p.way_out->by_own_trail = false, true);
     }},
};

TEST(HudGolden, NothingCanBeMissingUnnoticed) {
  std::map<std::string, int> spoilt;
  for (const Situation& situation : hud_situations()) {
    const Pixels whole = draw(situation.picture, situation.core->map());
    for (const auto& [what, spoil] : kSpoils) {
      hud::HudPicture picture = situation.picture;
      if (!spoil(picture)) continue;
      ++spoilt[what];
      EXPECT_GT(different(whole, draw(picture, situation.core->map())), kMostDifferent)
          << situation.name << " without " << what;
    }
  }
  EXPECT_EQ(spoilt.size(), kSpoils.size()) << "each stands in some situation";
}

}  // namespace
}  // namespace lifeline::test
