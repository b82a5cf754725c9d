#include "agents/sources/simulator/head_motion.hpp"

#include <cmath>
#include <numbers>

#include "common/base/angles.hpp"

namespace lifeline::sources {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kNoseDownRad = 2.0 * kDegree;  ///< people look at where they will tread

}  // namespace

HeadMotion::HeadMotion(std::uint64_t seed, Style style)
    : nose_down_rad_(style == Style::natural ? kNoseDownRad : 0.0) {
  Draw draw(seed);
  nod_ = swing(draw, 1.5, 0.48, 0.54);
  stride_ = nod_;
  stride_.period_s *= 2.0;  // left and right foot
  look_ = {swing(draw, 5.0, 5.0, 6.5), swing(draw, 3.0, 10.0, 13.0)};
  lean_ = swing(draw, 2.5, 4.0, 5.5);
  glance_ = {swing(draw, 10.0, 5.0, 6.0), swing(draw, 6.0, 3.1, 3.8)};
  if (style == Style::nodding) move_nodding(draw);
  if (style == Style::crawling) move_crawling(draw);
}

HeadMotion::Swing HeadMotion::swing(Draw& draw, double amplitude_deg, double shortest_s,
                                    double longest_s) {
  const double period_s = draw.between(shortest_s, longest_s);
  return {amplitude_deg * kDegree, period_s, draw.between(0.0, kTurn)};
}

void HeadMotion::move_nodding(Draw& draw) {
  const double step_deg = 1.5;  // what nod_ and stride_ add
  look_ = {swing(draw, kNoddingPitchDeg - step_deg, 2.6, 3.4), Swing{0.0, 1.0, 0.0}};
  lean_ = swing(draw, kNoddingRollDeg - step_deg, 3.6, 4.8);
  glance_ = {Swing{0.0, 1.0, 0.0}, Swing{0.0, 1.0, 0.0}};
}

/// Hand and knee after hand and knee, eyes on the floor ahead and up again.
void HeadMotion::move_crawling(Draw& draw) {
  nod_ = swing(draw, 4.0, 0.65, 0.8);
  stride_ = {6.0 * kDegree, 2.0 * nod_.period_s, nod_.phase_rad};
  look_ = {swing(draw, 8.0, 3.5, 5.0), swing(draw, 3.0, 8.0, 11.0)};
  lean_ = swing(draw, 3.0, 4.0, 5.5);
  nose_down_rad_ = 5.0 * kDegree;
  bob_m_ = kCrawlingRaisedM;
}

double HeadMotion::Swing::at(double t_s) const {
  return amplitude_rad * std::sin(kTurn * t_s / period_s + phase_rad);
}

HeadMotion::Lean HeadMotion::at(double t_s, double pace) const {
  return {.roll_rad = pace * stride_.at(t_s) + lean_.at(t_s),
          .pitch_rad = nose_down_rad_ + pace * nod_.at(t_s) + look_[0].at(t_s) + look_[1].at(t_s),
          .yaw_rad = glance_[0].at(t_s) + glance_[1].at(t_s),
          .raised_m = bob_m_ * pace * std::sin(kTurn * t_s / nod_.period_s)};
}

}  // namespace lifeline::sources
