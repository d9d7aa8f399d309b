#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/machine.h"
#include "report/measurement.h"

namespace nacre {

/// A line of [H96]'s table 1: a data set at a number of shells.
struct H96Case {
  std::string data_set;  ///< "HIPIP"
  std::string source;    ///< a phantom, or the name of a file
  std::string samples;   ///< "64 x 64 x 64"
  std::size_t levels = 0;
  MeasurementResult measured;
};

/// Maximum and summation of shells at so many uniform levels, through each backend, and the exact
/// walks of both.
std::vector<Method> h96_methods(std::size_t levels);

/// The table for machines: frames per second, triangles and errors, one line a case and method.
std::string h96_csv(const std::vector<H96Case>& cases);

/// The table as one page of HTML that needs nothing else, with the pictures.
std::string h96_page(const std::vector<H96Case>& cases, const MachineFacts& machine);

/// A case's picture of a mode, as displayed: the first backend's that drew it.
DisplayImage h96_picture(const H96Case& table_case, PictureMode mode);

}  // namespace nacre
