// curve-K.csv: the curve of one run, for plots and spreadsheets.
#pragma once
#include <filesystem>
#include <span>

#include "core/loading/curve_row.hpp"

namespace breccia {

/// Writes the whole curve, one line per row below a line of names; numbers read back as the same
/// doubles, a quantity that was not tracked is an empty field.
/// @throws WriteError
void write_curve(const std::filesystem::path& file, std::span<const CurveRow> rows);

}  // namespace breccia
