#pragma once

// Walks all fields of a wire message, whatever they are: to fill them with distinct values, and to
// compare. A field added to a struct stops this from compiling until it is listed here.

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/wire/messages.hpp"

namespace lifeline::test {

// clang-format off
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, Pose2> {
  auto& [a, b, c] = m; return std::tie(a, b, c);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::Envelope> {
  auto& [a, b, c, d, e, f, g] = m; return std::tie(a, b, c, d, e, f, g);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::LayerName> {
  auto& [a, b, c] = m; return std::tie(a, b, c);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::HelmetPose> {
  auto& [a, b, c, d, e, f, g] = m; return std::tie(a, b, c, d, e, f, g);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::HelmetScan> {
  auto& [a, b, c, d, e, f, g, h] = m; return std::tie(a, b, c, d, e, f, g, h);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::TsdTile> {
  auto& [a, b, c, d, e, f, g, h] = m; return std::tie(a, b, c, d, e, f, g, h);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::TileName> {
  auto& [a, b, c] = m; return std::tie(a, b, c);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::TileCopy> {
  auto& [a, b, c, d, e, f, g, h] = m; return std::tie(a, b, c, d, e, f, g, h);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::TileRequest> {
  auto& [a, b, c, d, e, f, g, h, i] = m; return std::tie(a, b, c, d, e, f, g, h, i);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::FixedTransform> {
  auto& [a, b, c, d] = m; return std::tie(a, b, c, d);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::DirectiveMember> {
  auto& [a, b, c, d, e] = m; return std::tie(a, b, c, d, e);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::MergeDirective> {
  auto& [a, b, c, d, e] = m; return std::tie(a, b, c, d, e);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::DirectiveCopy> {
  auto& [a, b, c] = m; return std::tie(a, b, c);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::MergeCandidate> {
  auto& [a, b, c, d, e, f] = m; return std::tie(a, b, c, d, e, f);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::MergeEvidence> {
  auto& [a, b, c, d, e, f, g, h] = m; return std::tie(a, b, c, d, e, f, g, h);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::LayerDigest> {
  auto& [a, b, c] = m; return std::tie(a, b, c);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::AgentStatus> {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, n, o, p, q, r, s, t, u, v, w, x, y, z, aa, ab] = m;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, n, o, p, q, r, s, t, u, v, w, x, y, z, aa, ab);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::Detection> {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, n] = m;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, n);
}
template <typename M> auto fields(M& m) requires std::same_as<std::remove_const_t<M>, wire::Alert> {
  auto& [a, b, c, d, e, f, g, h] = m; return std::tie(a, b, c, d, e, f, g, h);
}
// clang-format on

template <typename T>
inline constexpr bool kIsLeaf =
    std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::string>;
template <typename T>
inline constexpr bool kIsSequence = false;
template <typename T>
inline constexpr bool kIsSequence<std::vector<T>> = true;
template <typename T, std::size_t N>
inline constexpr bool kIsSequence<std::array<T, N>> = true;
template <typename T>
inline constexpr bool kIsVector = false;
template <typename T>
inline constexpr bool kIsVector<std::vector<T>> = true;

/// Gives every leaf below `value` the next of 1, 2, 3, ... in its own type; every vector two
/// elements.
template <typename T>
void fill(T& value, int& next) {
  if constexpr (std::is_same_v<T, bool>) {
    value = true;
  } else if constexpr (std::is_same_v<T, std::string>) {
    value = "text" + std::to_string(next++);
  } else if constexpr (std::is_floating_point_v<T>) {
    value = static_cast<T>(next++) + T(0.25);
  } else if constexpr (std::is_enum_v<T>) {
    value = static_cast<T>(2);
    if (value == T()) value = static_cast<T>(1);
  } else if constexpr (std::is_integral_v<T>) {
    value = static_cast<T>(next++);
  } else if constexpr (kIsSequence<T>) {
    if constexpr (kIsVector<T>) value.resize(2);
    for (auto& element : value) fill(element, next);
  } else {
    std::apply([&](auto&... field) { (fill(field, next), ...); }, fields(value));
  }
}

template <typename T>
T filled() {
  T value;
  int next = 3;  // beyond the defaults
  fill(value, next);
  return value;
}

template <typename T>
bool same(const T& a, const T& b) {
  if constexpr (kIsLeaf<T>) {
    return a == b;
  } else if constexpr (kIsSequence<T>) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!same(a[i], b[i])) return false;
    }
    return true;
  } else {
    const auto of_a = fields(a);
    const auto of_b = fields(b);
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return (same(std::get<I>(of_a), std::get<I>(of_b)) && ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(of_a)>>());
  }
}

/// Whether every field of `a`, down to the leaves, differs from that of `b`.
template <typename T>
bool all_differ(const T& a, const T& b) {
  if constexpr (kIsLeaf<T> || kIsSequence<T>) {
    return !same(a, b);
  } else {
    const auto of_a = fields(a);
    const auto of_b = fields(b);
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return (all_differ(std::get<I>(of_a), std::get<I>(of_b)) && ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(of_a)>>());
  }
}

}  // namespace lifeline::test
