#pragma once

namespace lifeline::serial {

/// The terminal calls that need the kernel's own header, which cannot be included beside
/// <termios.h>. All of them take an open descriptor.

/// Raw bytes, 8N1, no flow control, no modem lines watched, lines kept as they are at close, at
/// `baud` (any rate, not only the classic ones). 0, or the errno of the system's refusal.
[[nodiscard]] int make_raw(int descriptor, int baud);

/// The rate the device really runs at, which may differ from the one asked for; 0 if unknown.
[[nodiscard]] int actual_baud(int descriptor);

/// Asks the driver to hand bytes on at once instead of gathering them for some milliseconds (FTDI
/// adapters: 16 ms). Drivers that do not know the wish do not gather either.
void ask_for_low_latency(int descriptor);

/// Throws away what was received and not read.
void discard_input(int descriptor);

}  // namespace lifeline::serial
