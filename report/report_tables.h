#pragma once

#include <string>

#include "report/measurement.h"
#include "report/report_context.h"

namespace nacre {

/// The report for machines. Times in seconds, memory and files in bytes; `psnr_db` is null where
/// there is no error. A row that was left out has `left_out` and no figures.
std::string report_json(const MeasurementResult& result, const ReportContext& context);

/// The rows as comma-separated values (RFC 4180), one line of names first; empty fields where a row
/// has no such figure.
std::string report_csv(const MeasurementResult& result);

}  // namespace nacre
