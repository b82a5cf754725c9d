#pragma once

#include <memory>

#include "agents/sensing/scan_source.hpp"
#include "agents/sources/source_spec.hpp"

namespace lifeline::sources {

/// Plays a text file, plain or gzip-compressed, of one scan a line in columns of numbers:
/// `columns:FILE?first=24&beams=682&fov=240`. The defaults are those of the Hokuyo URG-04LX logs of
/// BreezySLAM. docs/sources.md lists the options.
///
/// wrong_use for options that make no sense, not_found where there is no such file; next() then
/// gives bad_data, with file and line, for a line with too few columns, for a time or range that is
/// no whole number or negative, and for a file without a scan.
[[nodiscard]] Result<std::unique_ptr<sensing::ScanSource>> open_columns_source(
    const SourceSpec& spec);

}  // namespace lifeline::sources
