// What stands still: corners, bands across the picture, the button's bar.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "agents/hud/draw_hud.hpp"

namespace lifeline::hud {
namespace {

constexpr std::size_t kMostBands = 2;
constexpr double kOld_s = 10.0;  // a map

std::string age_text(const std::optional<double>& age_s) {
  if (!age_s) return "NO MAP YET";
  return *age_s < 100.0 ? fmt::format("MAP {:.0f} s", *age_s)
                        : fmt::format("MAP {:.0f} min", std::min(*age_s / 60.0, 999.0));
}

Rectangle draw_map_state(const HudPicture& picture, double top, Pen& pen) {
  const double u = pen.unit(), size = 1.6 * u;
  const std::string whose = picture.shared ? "SHARED" : "OWN MAP",
                    age = age_text(picture.map_age_s);
  const double wide = std::max(pen.text_width(whose, size), pen.text_width(age, size));
  const Rectangle panel{0.0, top, wide + 1.2 * u, 4.4 * u};
  pen.fill(panel, kGround);
  pen.text({0.6 * u, top + 1.9 * u}, whose, {size, kInk});
  pen.text({0.6 * u, top + 3.8 * u}, age,
           {size, picture.map_age_s.value_or(0.0) < kOld_s ? kInk : kFind});
  return panel;
}

void draw_bars(const Point& at, const std::string& what, int bars, Pen& pen) {
  const double u = pen.unit();
  pen.text(at, what, {1.6 * u, kInk});
  for (int i = 0; i < 4; ++i) {
    const double high = (0.65 + 0.35 * i) * u;
    const Rectangle bar{at.x() + (4.6 + 1.2 * i) * u, at.y() - high, 0.9 * u, high};
    if (i < bars) {
      pen.fill(bar, kInk);
    } else {  // hollow, so that how many there could be is seen
      pen.frame(bar, 0.14 * u, kFaint);
    }
  }
}

Rectangle draw_trust(const HudPicture& picture, double top, Pen& pen) {
  const double u = pen.unit(), wide = 10.2 * u;
  const Rectangle panel{pen.width() - wide, top, wide, 4.4 * u};
  pen.fill(panel, kGround);
  draw_bars({panel.x + 0.6 * u, top + 1.9 * u}, "POS", picture.trust_bars, pen);
  draw_bars({panel.x + 0.6 * u, top + 3.8 * u}, "LINK", picture.link_bars, pen);
  return panel;
}

Rectangle draw_way_panel(const HudPicture& picture, Pen& pen) {
  const double u = pen.unit(), high = 5.6 * u;
  const bool known = picture.way_out.has_value();
  std::string large = "WAY OUT ?", small;
  if (known) {
    large = picture.way_out->arrived ? "ENTRY" : fmt::format("{:.0f} m", picture.way_out->length_m);
    small = picture.way_out->by_own_trail ? "OWN TRAIL" : "WAY OUT";
  }
  const double left = known ? 5.6 * u : 0.8 * u;
  const double size = known ? 2.5 * u : 1.8 * u;
  const double wide =
      left + std::max(pen.text_width(large, size), pen.text_width(small, 1.6 * u)) + 0.8 * u;
  const Rectangle panel{0.0, pen.height() - high, wide, high};
  pen.fill(panel, kGround);
  if (!known) {
    pen.text({left, panel.y + 3.4 * u}, large, {size, kInk});
    return panel;
  }
  const Point centre(2.8 * u, panel.y + high / 2.0);
  if (picture.heading_known && !picture.way_out->arrived) {
    pen.fill(arrow(centre, 4.6 * u, -picture.way_out->bearing_rad), kWay);
  } else if (!picture.heading_known) {
    pen.text(centre + Point(0.0, 1.2 * u), "?", {3.4 * u, kWay, Align::centre});
  } else {
    pen.fill(regular(centre, 1.8 * u, 4), kWay);
  }
  pen.text({left, panel.y + 2.7 * u}, large, {size, kWay});
  pen.text({left, panel.y + 4.8 * u}, small, {1.6 * u, kInk});
  return panel;
}

struct BandLook {
  Colour ground, letters;
};

BandLook look_of(const HudBand& band) {
  const bool calm = !band.waits;
  switch (band.kind) {
    case BandKind::mayday:
    case BandKind::own_mayday:
      return {band.flash ? kInk : kMayday, kGround};
    case BandKind::evacuate:
      return {kOrder, kGround};
    case BandKind::roll_call:
      return calm ? BandLook{kGround, kInk} : BandLook{kInk, kGround};
    case BandKind::lost:
      break;
  }
  return {kGround, kInk};
}

/// Where it is: metres and an arrow at the band's right end; how much of the width they take.
double draw_whereabouts(const HudBand& band, const Rectangle& at, Colour colour, Pen& pen) {
  if (!band.distance_m) return 0.0;
  const double u = pen.unit(), size = 2.3 * u;
  double right = at.x + at.width - 0.6 * u;
  if (band.bearing_rad) {
    const double long_px = std::min(3.4 * u, 0.85 * at.height);
    pen.fill(arrow({right - 1.7 * u, at.y + at.height / 2.0}, long_px, -*band.bearing_rad), colour);
    right -= 3.8 * u;
  }
  const std::string metres = fmt::format("{:.0f} m", *band.distance_m);
  pen.text({right, at.y + at.height / 2.0 + 0.85 * u}, metres, {size, colour, Align::right});
  return at.x + at.width - right + pen.text_width(metres, size) + 0.8 * u;
}

constexpr double kGap = 0.2;  // below a band, in units

double band_height(const HudBand& band) {
  return band.waits || !band.detail.empty() ? 4.6 : 2.8;
}

void draw_band(const HudBand& band, double top, std::size_t more, Pen& pen) {
  const double u = pen.unit();
  const Rectangle at{0.0, top, static_cast<double>(pen.width()), band_height(band) * u};
  const BandLook look = look_of(band);
  pen.fill(at, look.ground);
  if (band.waits || band.kind == BandKind::lost) {
    const double in = 0.25 * u;
    pen.frame({at.x + in, at.y + in, at.width - 2.0 * in, at.height - 2.0 * in}, 0.3 * u,
              look.letters);
  }
  const double room = at.width - draw_whereabouts(band, at, look.letters, pen) - 2.0 * u;
  const std::string title = band.title + (more > 0 ? fmt::format("  +{}", more) : "");
  pen.text({u, top + 2.4 * u}, pen.fitted(title, room, 2.1 * u), {2.1 * u, look.letters});
  pen.text({u, top + 3.95 * u}, pen.fitted(band.detail, room, 1.4 * u), {1.4 * u, look.letters});
  pen.fill(Rectangle{0.0, at.y + at.height, at.width, kGap * u}, kGround);
}

}  // namespace

std::vector<Rectangle> draw_panels(const HudPicture& picture, double top, Pen& pen) {
  return {draw_map_state(picture, top, pen), draw_trust(picture, top, pen),
          draw_way_panel(picture, pen)};
}

double bands_height(const HudPicture& picture, double unit) {
  double height = 0.0;
  for (std::size_t i = 0; i < std::min(picture.bands.size(), kMostBands); ++i)
    height += (band_height(picture.bands[i]) + kGap) * unit;
  return height;
}

void draw_bands(const HudPicture& picture, Pen& pen) {
  double top = 0.0;
  const std::size_t shown = std::min(picture.bands.size(), kMostBands);
  for (std::size_t i = 0; i < shown; ++i) {
    const bool is_last = i + 1 == shown;
    draw_band(picture.bands[i], top, is_last ? picture.bands.size() - shown : 0, pen);
    top += (band_height(picture.bands[i]) + kGap) * pen.unit();
  }
}

void draw_hold_bar(const HudPicture& picture, double top, Pen& pen) {
  if (picture.hold_share <= 0.0) return;
  const double u = pen.unit();
  const Rectangle bar{2.0 * u, top + 4.8 * u, pen.width() - 4.0 * u, 4.0 * u};
  pen.fill(bar, kGround);
  pen.fill(Rectangle{bar.x, bar.y, bar.width * picture.hold_share, bar.height}, kMayday);
  pen.frame(bar, 0.35 * u, kInk);
  const std::string words = picture.hold_cancels ? "HOLD: ALL WELL" : "HOLD: MAYDAY";
  pen.text({pen.width() / 2.0, bar.y + 2.75 * u}, words, {2.2 * u, kInk, Align::centre, true});
}

}  // namespace lifeline::hud
