#pragma once

#include <string>

#include "report/measurement.h"
#include "report/report_context.h"

namespace nacre {

/// The report as one page of HTML that needs nothing else: plots as inline SVG, pictures as data
/// addresses, no scripts. Part by part: what is compared, what came out in words, plots of error
/// against frame time, bytes and build time, a table, pictures with their differences from the
/// truth (red: too bright, blue: too dark, amplified alike for all), and the commands that repeat
/// each row.
std::string report_page(const MeasurementResult& result, const ReportContext& context);

}  // namespace nacre
