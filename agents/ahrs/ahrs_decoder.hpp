#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "agents/ahrs/ahrs_reading.hpp"

namespace lifeline::ahrs {

/// What a line of a sensor is.
enum class LineKind {
  reading,  ///< an attitude
  other,    ///< well-formed, but tells no attitude: an answer to a command, another sentence
  damaged,  ///< not as the sensor sends it: bytes were lost or changed on the way
};

struct DecodedLine {
  LineKind kind = LineKind::other;
  AhrsReading reading;     ///< of a reading
  std::string_view why{};  ///< what is wrong with a damaged one
};

/// What a kind of sensor says and wants to hear. Lines come without their end.
class AhrsDecoder {
 public:
  virtual ~AhrsDecoder() = default;
  [[nodiscard]] virtual DecodedLine decode(std::string_view line) const = 0;
  /// Sent once the port is open, so that the sensor begins to speak; empty where it does anyway.
  [[nodiscard]] virtual std::string start_commands() const { return {}; }
};

/// VectorNav's text sentences with an attitude: $VNYPR, $VNYMR, $VNYBA, $VNYIA (angles), $VNQTN,
/// $VNQMR (quaternion). Each ends with an XOR of two or a CRC-16 of four hexadecimal digits.
/// Status and counter, which may be appended, are passed over.
/// Source: VN-100 and VN-200 user manuals (UM001, UM004), communication protocol.
class VectorNavDecoder final : public AhrsDecoder {
 public:
  [[nodiscard]] DecodedLine decode(std::string_view line) const override;
};

/// The stream of a Sparton AHRS-8 that NorthTek's printmask switches on: `P:,ms,TAG,numbers,...`
/// with quaternion (tag q, w first), rates (gp, deg/s) and accelerations (ap). No checksum: a line
/// counts as damaged where its form, a number or the quaternion's length is wrong.
/// Source: public drivers for it (docs/sources.md); no recorded bytes were at hand.
class Ahrs8Decoder final : public AhrsDecoder {
 public:
  [[nodiscard]] DecodedLine decode(std::string_view line) const override;
  [[nodiscard]] std::string start_commands() const override;
};

/// `vectornav` or `ahrs8`; nothing for another name.
[[nodiscard]] std::unique_ptr<AhrsDecoder> make_decoder(std::string_view kind);

}  // namespace lifeline::ahrs
