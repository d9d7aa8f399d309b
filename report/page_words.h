#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "report/measurement.h"
#include "report/report_context.h"

namespace nacre {

// What the report's page says in words and numbers.

/// "shells, 24 levels, tolerance 0.02, egl".
std::string method_words(const Method& method);
/// "cpu: shells drawn by the processor alone".
std::string backend_words(const std::string& backend);
/// Colour and mark of a backend in plots.
int style_of(const std::string& backend);
/// The few letters beside a point: what tells methods of its part apart.
std::string plot_label(const Method& method);
/// The line under the pointer.
std::string plot_title(const Measured& row);

/// "1 234 567" with narrow spaces.
std::string count_words(std::size_t count);
/// "34.3", or "exact".
std::string decibel_words(const PictureError& error);
/// Three digits; "0" for none.
std::string error_words(double error);
/// Three digits, or all before the point.
std::string figure_words(double figure);
/// "12.3 (11.9 to 13)" in units.
std::string spread_words(const Spread& spread, double unit);
/// "120"; a dash where it is not known.
std::string megabyte_words(const std::optional<std::size_t>& bytes);

/// What came out of a part: the exact walk, samples, VTK, the fastest, smallest and closest shells.
std::string outcome_words(const std::vector<const Measured*>& rows);
/// The volume, how to read the page.
std::string opening_words(const MeasurementResult& result, const ReportContext& context);
/// How it was measured, and where.
std::string closing_words(const MeasurementResult& result, const ReportContext& context);

}  // namespace nacre
