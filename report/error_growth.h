#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/measurement.h"

namespace nacre {

/// What got worse since an earlier report: a line for each row and figure (RMSE over lit and over
/// all pixels, maximum error) that grew by more than `allowed`, "max-24-cpu: RMSE over lit pixels
/// is 0.031, was 0.027 (15 % more)".
///
/// Times are not looked at. Rows that only one of the two has are passed over: parts differ, and so
/// does what a machine can do. A row that is left out now and was not then is reported.
///
/// @param earlier  a `report.json`
/// @param allowed  part of the earlier figure
/// @throws Error   BadFile if it is not one; `name` stands for its path
std::vector<std::string> grown_errors(const MeasurementResult& result, std::string_view earlier,
                                      std::string_view name, double allowed = 0.1);

}  // namespace nacre
