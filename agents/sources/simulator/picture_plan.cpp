#include "agents/sources/simulator/picture_plan.hpp"

#include "agents/sources/simulator/houseexpo.hpp"

namespace lifeline::sources {
namespace {

/// Which pixels are floor; x to the right, y up, solid beyond the picture.
class Floor {
 public:
  explicit Floor(const files::GreyImage& picture) : picture_(picture) {}

  [[nodiscard]] bool at(int x, int y) const {
    if (x < 0 || y < 0 || x >= picture_.width || y >= picture_.height) return false;
    const std::size_t i = static_cast<std::size_t>(picture_.height - 1 - y) *
                              static_cast<std::size_t>(picture_.width) +
                          static_cast<std::size_t>(x);
    const int alpha = picture_.alphas.empty() ? 255 : picture_.alphas[i];
    const int shade = (picture_.shades[i] * alpha + 255 * (255 - alpha)) / 255;
    return shade >= kPictureFree;
  }

 private:
  const files::GreyImage& picture_;
};

/// Joins the borders along one line of pixel edges to the longest possible walls. `side(i)` is 1
/// where the floor lies below or left of edge i, -1 where it lies above or right, 0 where there is
/// no border; `add(from, to, side)` takes a wall.
template <typename Side, typename Add>
void join_borders(int count, Side side, Add add) {
  int begin = 0, current = 0;
  for (int i = 0; i <= count; ++i) {
    const int here = i < count ? side(i) : 0;
    if (here == current) continue;
    if (current != 0) add(begin, i, current);
    begin = i;
    current = here;
  }
}

}  // namespace

Result<FloorPlan> plan_from_picture(const files::GreyImage& picture, const std::string& name) {
  if (picture.width * kPictureCellM > kMaxPlanSideM ||
      picture.height * kPictureCellM > kMaxPlanSideM) {
    return fail(ErrorCode::bad_data, "{}: {} x {} pixels of {} m are more than {:.0f} m on a side",
                name, picture.width, picture.height, kPictureCellM, kMaxPlanSideM);
  }
  const Floor floor(picture);
  FloorPlan plan;
  plan.name = name;
  double length_m = 0.0;
  const auto add = [&](int ax, int ay, int bx, int by) {
    const Eigen::Vector2d a(ax, ay), b(bx, by);
    plan.walls.push_back({a * kPictureCellM, b * kPictureCellM});
    length_m += (b - a).norm() * kPictureCellM;
  };
  for (int y = 0; y <= picture.height; ++y) {
    const auto side = [&](int x) { return int{floor.at(x, y - 1)} - int{floor.at(x, y)}; };
    join_borders(picture.width, side, [&](int from, int to, int below) {
      below > 0 ? add(to, y, from, y) : add(from, y, to, y);
    });
  }
  for (int x = 0; x <= picture.width; ++x) {
    const auto side = [&](int y) { return int{floor.at(x - 1, y)} - int{floor.at(x, y)}; };
    join_borders(picture.height, side, [&](int from, int to, int left) {
      left > 0 ? add(x, from, x, to) : add(x, to, x, from);
    });
  }
  if (plan.walls.empty()) {
    return fail(ErrorCode::bad_data, "{}: no pixel is as bright as floor ({})", name, kPictureFree);
  }
  if (length_m > kMaxWallsM) {
    return fail(ErrorCode::bad_data, "{}: {:.0f} m of wall are more than {:.0f} m", name, length_m,
                kMaxWallsM);
  }
  return plan;
}

Result<FloorPlan> read_picture_plan(const std::filesystem::path& file) {
  const auto picture = files::read_grey_image(file);
  if (!picture) return forward_error(picture);
  return plan_from_picture(*picture, file.string());
}

}  // namespace lifeline::sources
