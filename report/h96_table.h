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

/// A frame rate that the paper has.
struct H96Figure {
  std::string data_set;  ///< as in `H96Case`
  std::size_t levels = 0;
  std::string mode;  ///< "maximum" or "summation"
  double frames_per_second = 0.0;
};

/// The paper's figures, as somebody who has it at hand wrote them down: lines of
/// `data_set,levels,mode,frames_per_s` under these names.
/// @param name    of the file, for errors
/// @throws Error  BadFile for any other line
std::vector<H96Figure> read_h96_figures(const std::string& csv, const std::string& name);

/// Maximum and summation of shells at so many uniform levels, through each backend, and the exact
/// walks of both.
std::vector<Method> h96_methods(std::size_t levels);

/// The table for machines: frames per second, today's and the paper's, triangles and errors, one
/// line a case and method.
std::string h96_csv(const std::vector<H96Case>& cases, const std::vector<H96Figure>& paper);

/// The table as one page of HTML that needs nothing else, with the pictures.
std::string h96_page(const std::vector<H96Case>& cases, const std::vector<H96Figure>& paper,
                     const MachineFacts& machine);

/// A case's picture of a mode, as displayed: the first backend's that drew it.
DisplayImage h96_picture(const H96Case& table_case, PictureMode mode);

}  // namespace nacre
