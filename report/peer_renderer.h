#pragma once

#include <cstddef>
#include <string>

#include "core/image.h"
#include "report/method.h"

namespace nacre {

/// What a peer made of a view.
struct PeerFrame {
  Image picture;
  double seconds = 0.0;  ///< from the camera to the picture in memory
  std::string device;    ///< what drew: "VTK 9.1.0, 2 threads"
};

/// Another program that draws the same volume, with the same emission and views.
class PeerRenderer {
 public:
  virtual ~PeerRenderer() = default;

  /// @param view    number of the view
  /// @throws Error  Unsupported if it cannot
  virtual PeerFrame draw(const PeerRecipe& recipe, std::size_t view) = 0;
};

}  // namespace nacre
