#include "coordinator/export/mission_report_pdf.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/files/canvas.hpp"
#include "common/files/finds_json.hpp"

namespace lifeline {
namespace {

using files::Canvas;
using Row = std::vector<std::string>;

// A4 in points.
constexpr int kWidth = 595, kHeight = 842;
constexpr double kMargin = 42.0, kLine = 13.0, kRoom = kWidth - 2.0 * kMargin;
constexpr files::Colour kPage = 0xffffff, kInk = 0x1f2a37, kFaint = 0x5b6776, kRule = 0xcbd2da;
const Canvas::TextStyle kTitle{20.0, true, kInk}, kHeading{12.0, true, kInk};
const Canvas::TextStyle kText{9.0, false, kInk}, kBold{9.0, true, kInk};
const Canvas::TextStyle kSmall{8.0, false, kFaint};
constexpr std::size_t kMostLines = 3;     // of a cell
constexpr std::size_t kMostRows = 2'000;  // of a table; CSV has them all

/// One after the other from above, on as many pages as it takes.
class Pages {
 public:
  explicit Pages(std::string foot)
      : canvas_(kWidth, kHeight, kPage, files::DrawingFormat::pdf), foot_(std::move(foot)) {
    draw_foot();
  }

  void title(const std::string& text) {
    y_ += 20.0;
    canvas_.text(kMargin, y_, canvas_.fitted(text, kRoom, kTitle), kTitle);
    y_ += 8.0;
  }
  void line(const std::string& text, const Canvas::TextStyle& style = kText) {
    need(kLine);
    y_ += kLine;
    canvas_.text(kMargin, y_, canvas_.fitted(text, kRoom, style), style);
  }
  void map(const StoryMap& map, const std::vector<files::PicturePath>& paths) {
    constexpr double kLeast = 260.0;
    need(kLeast);
    y_ += 10.0;
    y_ += files::draw_map_picture(canvas_, {kMargin, y_, kRoom, kHeight - kMargin - 20.0 - y_},
                                  map.grid, paths, map.title);
  }
  /// `widths`: shares of the page's width.
  void table(const std::string& heading, const Row& names, const std::vector<double>& widths,
             const std::vector<Row>& rows) {
    need(5.0 * kLine);
    y_ += 2.0 * kLine;
    canvas_.text(kMargin, y_, fmt::format("{} ({})", heading, rows.size()), kHeading);
    y_ += 3.0;
    if (rows.empty()) return line("none", kSmall);
    draw_row(names, widths, kBold);
    for (std::size_t i = 0; i < std::min(rows.size(), kMostRows); ++i) {
      if (y_ + kMostLines * kLine > kHeight - kMargin - 20.0) {
        need(kMostLines * kLine);
        draw_row(names, widths, kBold);
      }
      draw_row(rows[i], widths, kText);
    }
    if (rows.size() > kMostRows) line("the rest stands in the CSV files", kSmall);
  }
  [[nodiscard]] Result<std::string> finish() { return canvas_.finish(); }

 private:
  void need(double height) {
    if (y_ + height <= kHeight - kMargin - 20.0) return;
    canvas_.new_page();
    ++page_;
    draw_foot();
    y_ = kMargin;
  }
  void draw_foot() {
    const std::string text = fmt::format("{} · page {}", foot_, page_);
    canvas_.text(kMargin, kHeight - kMargin + 8.0, text, kSmall);
  }
  /// The last cell takes up to three lines.
  void draw_row(const Row& cells, const std::vector<double>& widths,
                const Canvas::TextStyle& style) {
    y_ += kLine;
    double x = kMargin;
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
      canvas_.text(x, y_, canvas_.fitted(cells[i], widths[i] * kRoom - 6.0, style), style);
      x += widths[i] * kRoom;
    }
    const auto lines = wrapped(cells.back(), widths[cells.size() - 1] * kRoom - 6.0, style);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (i > 0) y_ += kLine;
      canvas_.text(x, y_, lines[i], style);
    }
    canvas_.line({{kMargin, y_ + 3.5}, {kMargin + kRoom, y_ + 3.5}}, 0.5, kRule);
  }
  std::vector<std::string> wrapped(const std::string& text, double width,
                                   const Canvas::TextStyle& style) {
    std::vector<std::string> lines{""};
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      std::string& line = lines.back();
      const std::string longer = line.empty() ? word : line + " " + word;
      if (line.empty() || lines.size() == kMostLines ||
          canvas_.text_width(longer, style) <= width) {
        line = longer;
      } else {
        lines.push_back(word);
      }
    }
    for (std::string& line : lines) line = canvas_.fitted(line, width, style);
    return lines;
  }

  Canvas canvas_;
  std::string foot_;
  double y_ = kMargin;
  int page_ = 1;
};

std::string mission_time_at(const MissionStory& story, Timestamp at) {
  return mission_time(at - story.first);
}

std::vector<Row> helmet_rows(const MissionStory& story) {
  std::vector<Row> rows;
  for (const HelmetTrack& track : story.tracks) {
    const bool moved = !track.poses.empty();
    rows.push_back({track.name(), std::to_string(track.layer.floor.value),
                    moved ? mission_time_at(story, track.poses.front().stamp) : "-",
                    moved ? mission_time_at(story, track.poses.back().stamp) : "-",
                    fmt::format("{:.0f} m", track.walked_m()),
                    track.T_common_map ? "in the common map" : "apart"});
  }
  return rows;
}

std::vector<Row> find_rows(const MissionStory& story) {
  std::vector<Row> rows;
  for (const auto& find : files::to_json(story.finds)) {
    std::string seen_by;
    for (const auto& id : find.at("seen_by"))
      seen_by += (seen_by.empty() ? "" : ", ") + id.get<std::string>();
    rows.push_back({find.at("kind"), find.at("state"), find.at("frame"),
                    fmt::format("({:.1f}, {:.1f})", find.at("x_m").get<double>(),
                                find.at("y_m").get<double>()),
                    fmt::format("{:.0f} %", 100.0 * find.at("confidence").get<double>()), seen_by});
  }
  return rows;
}

std::vector<Row> alert_rows(const MissionStory& story) {
  std::vector<Row> rows;
  for (const auto& [at, alert] : story.alerts) {
    rows.push_back({mission_time_at(story, at), to_string(alert.kind), to_string(alert.state),
                    alert.issuer_id, alert.subject_id.empty() ? "everybody" : alert.subject_id,
                    alert.text});
  }
  return rows;
}

std::vector<Row> merge_rows(const MissionStory& story) {
  std::vector<Row> rows;
  for (const auto& [at, evidence] : story.merges) {
    rows.push_back({mission_time_at(story, at), to_text(evidence.a), to_text(evidence.b),
                    to_string(evidence.verdict), evidence.reason});
  }
  return rows;
}

}  // namespace

Result<std::string> to_report_pdf(const MissionStory& story) {
  const std::string name =
      story.mission_id.empty() ? std::string("Saved map") : "Mission " + story.mission_id;
  Pages pages(name);
  pages.title(name);
  if (story.last > story.first) {
    pages.line(fmt::format("From {} to {} (UTC), {}", utc_text(story.first), utc_text(story.last),
                           mission_time(story.last - story.first)));
  }
  if (!story.common_map_sha256.empty())
    pages.line("Common map SHA-256 " + story.common_map_sha256, kSmall);
  for (const StoryMap& map : story.maps) pages.map(map, picture_paths(story, map));
  pages.table("Helmets", {"Helmet", "Floor", "From", "To", "Walked", "Map"},
              {0.25, 0.1, 0.13, 0.13, 0.14, 0.25}, helmet_rows(story));
  pages.table("Finds", {"What", "State", "Frame", "At (m)", "Sure", "Seen by"},
              {0.13, 0.15, 0.2, 0.18, 0.1, 0.24}, find_rows(story));
  pages.table("Alerts", {"At", "What", "State", "From", "For", "Text"},
              {0.11, 0.12, 0.16, 0.16, 0.16, 0.29}, alert_rows(story));
  pages.table("Merges", {"At", "Map", "With", "Verdict", "Why"}, {0.11, 0.15, 0.15, 0.12, 0.47},
              merge_rows(story));
  return pages.finish();
}

}  // namespace lifeline
